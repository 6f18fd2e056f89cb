import type {BufferGeometry, LineSegments, Material, Mesh} from 'three';
import type {GLTF, GLTFLoaderPlugin, GLTFParser} from 'three/addons/loaders/GLTFLoader.js';

import type {Tutte} from './index.js';

/** A plug-in of GLTFLoader: `loader.register((parser) => new TutteMeshCompression(parser, tutte))`. */
export class TutteMeshCompression implements GLTFLoaderPlugin {
  constructor(parser: GLTFParser, tutte: Tutte | Promise<Tutte>);
  readonly name: string;
  loadBufferView(index: number): Promise<ArrayBuffer> | null;
}

/** Polygons: ring `i` has the vertices `vertices[starts[i]]` to `vertices[starts[i + 1] - 1]`. */
export interface PolygonRings {
  /** Numbers of the geometry's vertices. */
  vertices: Uint32Array;
  /** One more than there are rings. */
  starts: Uint32Array;
}

/**
 * The polygons of a mesh that GLTFLoader made, compressed or not: from EXT_mesh_polygon (holes are rings of their own) or
 * FB_ngon_encoding, or else its triangles.
 */
export function loadPolygons(gltf: GLTF, mesh: Mesh): Promise<PolygonRings>;

/** The polygons' edges, each once, as index of a geometry for LineSegments that shares the mesh's attributes. */
export function polygonEdges(gltf: GLTF, mesh: Mesh): Promise<BufferGeometry>;

/** The polygons' edges as lines, to be added to the mesh. They follow its morph targets. */
export function polygonLines(gltf: GLTF, mesh: Mesh, material?: Material): Promise<LineSegments>;
