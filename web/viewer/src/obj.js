/** Wavefront OBJ with its polygons. Groups, materials, lines and points are passed over. */

/**
 * @param {string} text @param {string} name
 * @returns {import('./polygons.js').PolygonMesh}
 */
export function readObj(text, name) {
  const pools = {v: [], vt: [], vn: []};
  const corners = new Map(),
    wedges = [],
    rings = [];
  const number = (word, pool, size) => {
    if (!word) return -1;
    const value = Number(word),
      count = pool.length / size;
    const index = value < 0 ? count + value : value - 1;
    if (!Number.isInteger(index) || index < 0 || index >= count)
      throw new Error(`${name}: '${word}' is no such element`);
    return index;
  };
  const wedgeOf = (word) => {
    const [v, t, n] = word.split('/');
    const parts = [number(v, pools.v, 3), number(t, pools.vt, 2), number(n, pools.vn, 3)];
    const key = parts.join('/');
    if (!corners.has(key)) corners.set(key, wedges.push(parts) - 1);
    return corners.get(key);
  };
  for (const line of text.replaceAll('\\\n', ' ').split('\n')) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === 'v' || kind === 'vn') pools[kind].push(...words.slice(0, 3).map(Number));
    else if (kind === 'vt') pools.vt.push(Number(words[0]), 1 - Number(words[1] ?? 0));
    else if (kind === 'f' && words.length > 2) rings.push(words.map(wedgeOf));
  }
  if (rings.length === 0) throw new Error(`${name} has no faces`);
  if (pools.v.some((value) => !Number.isFinite(value))) throw new Error(`${name} has a vertex that is no number`);
  const everywhere = (part) => wedges.every((wedge) => wedge[part] >= 0);
  return {
    name,
    rings,
    position: picked(pools.v, 3, wedges, 0),
    ...(everywhere(2) && {normal: unit(picked(pools.vn, 3, wedges, 2))}),
    ...(everywhere(1) && {uv: picked(pools.vt, 2, wedges, 1)}),
  };
}

/** @param {number[]} pool @param {number} size @param {number[][]} wedges @param {number} part */
function picked(pool, size, wedges, part) {
  const values = new Float32Array(size * wedges.length);
  wedges.forEach((wedge, i) => {
    for (let k = 0; k < size; ++k) values[size * i + k] = pool[size * wedge[part] + k];
  });
  return values;
}

/** glTF wants normals of length 1. @param {Float32Array} normals */
function unit(normals) {
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]);
    if (length > 0) for (let k = 0; k < 3; ++k) normals[i + k] /= length;
    else normals[i + 2] = 1;
  }
  return normals;
}
