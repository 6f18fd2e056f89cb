// Polygons of a glTF primitive, whichever way the file tells them.

/** Of each index type, the number that stands between two rings. @type {Record<number, number>} */
const restarts = {1: 0xFF, 2: 0xFFFF, 4: 0xFFFFFFFF};

/** @typedef {import('./three.js').PolygonRings} PolygonRings */
/** @typedef {Uint8Array | Uint16Array | Uint32Array} Indices */

/**
 * The rings of EXT_mesh_polygon's loopIndices: between two stands the restart value.
 * @param {Indices} loops
 * @returns {PolygonRings}
 */
export function ringsOfLoops(loops) {
  const restart = restarts[loops.BYTES_PER_ELEMENT];
  const vertices = new Uint32Array(loops.length), starts = [0];
  let count = 0;
  for (const index of loops) {
    if (index !== restart) vertices[count++] = index;
    else if (count > starts[starts.length - 1]) starts.push(count);
  }
  if (count > starts[starts.length - 1]) starts.push(count);
  return {vertices: vertices.slice(0, count), starts: Uint32Array.from(starts)};
}

/**
 * The rings of triangles, or, as FB_ngon_encoding says, of fans: consecutive triangles with the same first vertex.
 * @param {ArrayLike<number>} triangles  three indices each
 * @param {boolean} fans
 * @returns {PolygonRings}
 */
export function ringsOfTriangles(triangles, fans) {
  const vertices = new Uint32Array(triangles.length), starts = [];
  let count = 0;
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const goesOn = fans && i > 0 && triangles[i] === triangles[i - 3];
    if (!goesOn) {
      starts.push(count);
      vertices[count++] = triangles[i];
      vertices[count++] = triangles[i + 1];
    }
    vertices[count++] = triangles[i + 2];
  }
  starts.push(count);
  return {vertices: vertices.slice(0, count), starts: Uint32Array.from(starts)};
}

/**
 * For each vertex the first one with the same values: vertices that other attributes keep apart are in one place.
 * @param {{count: number, read: (vertex: number) => (number | bigint)[]}} values
 */
export function firstWithSame({count, read}) {
  const first = new Uint32Array(count);
  /** @type {Map<string, number>} */
  const known = new Map();
  for (let vertex = 0; vertex < count; ++vertex) {
    const key = read(vertex).join();
    const same = known.get(key);
    first[vertex] = same ?? vertex;
    if (same === undefined) known.set(key, vertex);
  }
  return first;
}

/**
 * The edges of rings, each once: two vertices per edge.
 * @param {PolygonRings} rings
 * @param {Uint32Array} [placeOf]  equal for vertices in one place, whose edges are one
 */
export function edgesOfRings({vertices, starts}, placeOf) {
  const edges = new Uint32Array(2 * vertices.length);
  const vertexCount = vertices.reduce((most, vertex) => Math.max(most, vertex), 0) + 1;
  const place = placeOf ? (/** @type {number} */ vertex) => placeOf[vertex] : (/** @type {number} */ vertex) => vertex;
  /** @type {Set<number>} */
  const known = new Set();
  let count = 0;
  for (let ring = 0; ring + 1 < starts.length; ++ring) {
    for (let i = starts[ring], last = starts[ring + 1] - 1; i <= last; ++i) {
      const a = vertices[i], b = vertices[i === last ? starts[ring] : i + 1];
      const from = place(a), to = place(b);
      const key = Math.min(from, to) * vertexCount + Math.max(from, to);
      if (known.has(key)) continue;
      known.add(key);
      edges[count++] = a;
      edges[count++] = b;
    }
  }
  return edges.subarray(0, count);
}
