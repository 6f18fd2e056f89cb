import {BufferAttribute, BufferGeometry, LineSegments} from 'three';

import {CompressedViews} from './gltf.js';
import {EXTENSION_NAME} from './index.js';
import {edgesOfRings, firstWithSame, ringsOfLoops, ringsOfTriangles} from './polygons.js';

/** A plug-in of GLTFLoader. */
export class TutteMeshCompression {
  /**
   * @param {any} parser  GLTFLoader's
   * @param {import('./index.js').Tutte | Promise<import('./index.js').Tutte>} tutte
   */
  constructor(parser, tutte) {
    this.name = EXTENSION_NAME;
    this.views = new CompressedViews(parser.json, tutte, (buffer) => parser.getDependency('buffer', buffer));
  }

  /** @param {number} index @returns {Promise<ArrayBuffer> | null} */
  loadBufferView(index) {
    const bytes = this.views.load(index);
    return bytes && bytes.then((array) => /** @type {ArrayBuffer} */ (array.buffer));
  }
}

/**
 * The definition in the file of the primitive that a mesh was made from.
 * @param {any} gltf @param {any} mesh
 */
function primitiveOf(gltf, mesh) {
  const place = gltf.parser.associations.get(mesh);
  return gltf.parser.json.meshes?.[place?.meshes]?.primitives?.[place?.primitives ?? 0];
}

/** @type {import('./three.js').loadPolygons} */
export async function loadPolygons(gltf, mesh) {
  const primitive = primitiveOf(gltf, mesh);
  const polygons = primitive?.extensions?.EXT_mesh_polygon;
  if (polygons?.loopIndices !== undefined) {
    const loops = await gltf.parser.getDependency('accessor', polygons.loopIndices);
    return ringsOfLoops(loops.array);
  }
  const {index, attributes} = mesh.geometry;
  const triangles = index ? index.array : Uint32Array.from({length: attributes.position.count}, (_, i) => i);
  return ringsOfTriangles(triangles, primitive?.extensions?.FB_ngon_encoding !== undefined);
}

/** Equal for vertices that are, and stay, in one place, whatever bones and morph targets do. @param {any} geometry */
function placesOf({attributes, morphAttributes}) {
  const {position, skinIndex, skinWeight} = attributes;
  const deciding = [position, skinIndex, skinWeight, ...(morphAttributes.position ?? [])].filter((attribute) => attribute);
  const read = (/** @type {number} */ vertex) => deciding.flatMap((attribute) =>
    Array.from({length: attribute.itemSize}, (_, component) => attribute.getComponent(vertex, component)));
  return firstWithSame({count: position.count, read});
}

/** @type {import('./three.js').polygonEdges} */
export async function polygonEdges(gltf, mesh) {
  const edges = edgesOfRings(await loadPolygons(gltf, mesh), placesOf(mesh.geometry));
  const geometry = new BufferGeometry();
  for (const [name, attribute] of Object.entries(mesh.geometry.attributes)) geometry.setAttribute(name, attribute);
  geometry.morphAttributes = mesh.geometry.morphAttributes;
  geometry.morphTargetsRelative = mesh.geometry.morphTargetsRelative;
  geometry.setIndex(new BufferAttribute(edges, 1));
  return geometry;
}

/** @type {import('./three.js').polygonLines} */
export async function polygonLines(gltf, mesh, material) {
  const lines = new LineSegments(await polygonEdges(gltf, mesh), material);
  lines.name = `${mesh.name} polygons`;
  lines.morphTargetInfluences = mesh.morphTargetInfluences;
  lines.morphTargetDictionary = mesh.morphTargetDictionary;
  return lines;
}
