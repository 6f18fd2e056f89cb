import {Earcut} from 'three/src/extras/Earcut.js';
import {joinGlb} from './glb.js';

/**
 * A polygon mesh: values per vertex, and per polygon its vertices.
 * @typedef {{name: string, position: Float32Array, normal?: Float32Array, uv?: Float32Array,
 *   rings: number[][]}} PolygonMesh
 */

const RESTART = 0xffffffff;

/** A plain GLB with the polygons as EXT_mesh_polygon. @param {PolygonMesh} mesh */
export function glbOf(mesh) {
  const file = new Builder();
  const indices = [],
    indexOffsets = [],
    loops = [],
    loopOffsets = [];
  for (const ring of mesh.rings) {
    indexOffsets.push(indices.length);
    if (loops.length > 0) loops.push(RESTART);
    loopOffsets.push(loops.length);
    for (const corner of ring) loops.push(corner);
    for (const corner of triangulate(mesh.position, ring)) indices.push(corner);
  }
  const attributes = {POSITION: file.add(mesh.position, 'VEC3', 34962, bounds(mesh.position))};
  if (mesh.normal) attributes.NORMAL = file.add(mesh.normal, 'VEC3', 34962);
  if (mesh.uv) attributes.TEXCOORD_0 = file.add(mesh.uv, 'VEC2', 34962);
  const polygons = {
    count: mesh.rings.length,
    indicesOffsets: file.add(Uint32Array.from(indexOffsets), 'SCALAR'),
    loopIndices: file.add(Uint32Array.from(loops), 'SCALAR'),
    loopIndicesOffsets: file.add(Uint32Array.from(loopOffsets), 'SCALAR'),
  };
  return file.finish({
    asset: {version: '2.0', generator: 'Tutte viewer'},
    extensionsUsed: ['EXT_mesh_polygon'],
    scene: 0,
    scenes: [{nodes: [0]}],
    nodes: [{mesh: 0, name: mesh.name}],
    meshes: [
      {
        name: mesh.name,
        primitives: [
          {
            attributes,
            indices: file.add(Uint32Array.from(indices), 'SCALAR', 34963),
            extensions: {EXT_mesh_polygon: polygons},
          },
        ],
      },
    ],
  });
}

/** Collects accessors and their bytes. */
class Builder {
  accessors = [];
  bufferViews = [];
  parts = [];
  size = 0;

  /** @param {Float32Array | Uint32Array} values @param {string} type @param {number} [target] @param {any} [extra] */
  add(values, type, target, extra) {
    const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    this.bufferViews.push({buffer: 0, byteOffset: this.size, byteLength: bytes.length, ...(target && {target})});
    this.parts.push(bytes);
    this.size += bytes.length;
    const componentType = values instanceof Float32Array ? 5126 : 5125;
    const count = values.length / {SCALAR: 1, VEC2: 2, VEC3: 3}[type];
    return this.accessors.push({bufferView: this.bufferViews.length - 1, componentType, count, type, ...extra}) - 1;
  }

  /** @param {any} json */
  finish(json) {
    const bin = new Uint8Array(this.size);
    this.parts.forEach((part, i) => bin.set(part, this.bufferViews[i].byteOffset));
    return joinGlb(
      {...json, accessors: this.accessors, bufferViews: this.bufferViews, buffers: [{byteLength: this.size}]},
      bin
    );
  }
}

/** @param {Float32Array} position */
function bounds(position) {
  const min = [Infinity, Infinity, Infinity],
    max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < position.length; ++i) {
    min[i % 3] = Math.min(min[i % 3], position[i]);
    max[i % 3] = Math.max(max[i % 3], position[i]);
  }
  return {min, max};
}

/** The triangles of a polygon, concave ones too: ears of it as seen along its normal. */
function triangulate(position, ring) {
  if (ring.length === 3) return ring;
  const [nx, ny, nz] = normalOf(position, ring);
  const [ax, ay, az] = [Math.abs(nx), Math.abs(ny), Math.abs(nz)];
  const [u, v, flip] = az >= ax && az >= ay ? [0, 1, nz < 0] : ax >= ay ? [1, 2, nx < 0] : [2, 0, ny < 0];
  const flat = ring.flatMap((corner) => {
    const a = position[3 * corner + u],
      b = position[3 * corner + v];
    return flip ? [b, a] : [a, b];
  });
  const ears = Earcut.triangulate(flat, [], 2);
  if (ears.length !== 3 * (ring.length - 2))
    return ring.slice(2).flatMap((corner, i) => [ring[0], ring[i + 1], corner]);
  const triangles = [];
  for (let i = 0; i < ears.length; i += 3)
    triangles.push(...turned(ears.slice(i, i + 3), flat).map((ear) => ring[ear]));
  return triangles;
}

/** Three corners, counter-clockwise. */
function turned([a, b, c], flat) {
  const area =
    (flat[2 * b] - flat[2 * a]) * (flat[2 * c + 1] - flat[2 * a + 1]) -
    (flat[2 * c] - flat[2 * a]) * (flat[2 * b + 1] - flat[2 * a + 1]);
  return area < 0 ? [a, c, b] : [a, b, c];
}

/** Newell's normal, not of unit length. */
function normalOf(position, ring) {
  const normal = [0, 0, 0];
  ring.forEach((corner, i) => {
    const next = ring[(i + 1) % ring.length];
    for (let k = 0; k < 3; ++k) {
      const u = (k + 1) % 3,
        v = (k + 2) % 3;
      normal[k] +=
        (position[3 * corner + u] - position[3 * next + u]) * (position[3 * corner + v] + position[3 * next + v]);
    }
  });
  return normal;
}
