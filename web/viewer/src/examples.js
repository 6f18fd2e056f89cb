/** Models that need no file. */

/** @typedef {import('./polygons.js').PolygonMesh} PolygonMesh */

/** @type {Record<string, () => PolygonMesh>} */
export const generated = {'Hexagons and 12 pentagons': () => ball(12), 'Knot of quads': () => knot(240, 24)};

/**
 * The dual of an icosahedron with divided triangles: hexagons, and pentagons at its corners.
 * @param {number} n  parts of an edge
 */
function ball(n) {
  const {points, triangles} = dividedIcosahedron(n);
  const position = new Float32Array(3 * triangles.length), around = points.map(() => /** @type {number[]} */ ([]));
  triangles.forEach((corners, i) => {
    const center = unit([0, 1, 2].map((k) => corners.reduce((sum, corner) => sum + points[corner][k], 0)));
    position.set(center, 3 * i);
    for (const corner of corners) around[corner].push(i);
  });
  const rings = around.map((faces, i) => sorted(faces, points[i], position));
  return {name: 'Hexagons and 12 pentagons', position, normal: position.slice(), rings};
}

/** Points of the unit sphere, and triangles. @param {number} n */
function dividedIcosahedron(n) {
  const g = (1 + Math.sqrt(5)) / 2;
  const corners = [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
    [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]].map(unit);
  const faces = [
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
    [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]];
  const points = [], known = new Map(), triangles = [];
  for (const face of faces) {
    const at = (i, j) => {
      const parts = [n - i - j, i, j].map((weight, k) => [face[k], weight]).filter(([, weight]) => weight > 0);
      const key = parts.sort((a, b) => a[0] - b[0]).join();
      if (!known.has(key)) {
        const sum = (k) => parts.reduce((all, [corner, weight]) => all + weight * corners[corner][k], 0);
        known.set(key, points.push(unit([0, 1, 2].map(sum))) - 1);
      }
      return known.get(key);
    };
    for (let i = 0; i < n; ++i) {
      for (let j = 0; i + j < n; ++j) {
        triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
        if (i + j + 1 < n) triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
      }
    }
  }
  return {points, triangles};
}

/** Faces counter-clockwise around a point of the sphere. */
function sorted(faces, point, position) {
  const across = unit(cross(point, Math.abs(point[0]) < .9 ? [1, 0, 0] : [0, 1, 0])), up = cross(point, across);
  const angle = (face) => {
    const place = position.subarray(3 * face, 3 * face + 3);
    return Math.atan2(dot(place, up), dot(place, across));
  };
  return faces.map((face) => [angle(face), face]).sort((a, b) => a[0] - b[0]).map(([, face]) => face);
}

/** A tube along a (2, 3) torus knot, with texture coordinates. @param {number} long @param {number} round */
function knot(long, round) {
  const stride = round + 1, count = (long + 1) * stride;
  const position = new Float32Array(3 * count), normal = new Float32Array(3 * count), uv = new Float32Array(2 * count);
  for (let i = 0; i <= long; ++i) {
    const {center, across, up} = frame((i % long) / long * 2 * Math.PI);
    for (let j = 0; j <= round; ++j) {
      const angle = (j % round) / round * 2 * Math.PI, at = i * stride + j;
      for (let k = 0; k < 3; ++k) {
        normal[3 * at + k] = Math.cos(angle) * across[k] + Math.sin(angle) * up[k];
        position[3 * at + k] = center[k] + .42 * normal[3 * at + k];
      }
      uv.set([6 * i / long, j / round], 2 * at);
    }
  }
  const rings = [];
  for (let i = 0; i < long; ++i) {
    for (let at = i * stride; at < i * stride + round; ++at) rings.push([at, at + stride, at + stride + 1, at + 1]);
  }
  return {name: 'Knot of quads', position, normal, uv, rings};
}

function frame(t) {
  const at = (s) => {
    const out = 2 + Math.cos(3 * s);
    return [out * Math.cos(2 * s), out * Math.sin(2 * s), 1.2 * Math.sin(3 * s)];
  };
  const center = at(t), ahead = at(t + 1e-3);
  const tangent = unit(ahead.map((value, k) => value - center[k]));
  const across = unit(cross(tangent, [0, 0, 1]));
  return {center, across, up: cross(across, tangent)};
}

function unit(v) {
  const length = Math.hypot(...v);
  return v.map((value) => value / length);
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
