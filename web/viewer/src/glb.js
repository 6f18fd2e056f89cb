/** GLB files in parts, and made from polygons. */

const MAGIC = 0x46546c67,
  JSON_CHUNK = 0x4e4f534a,
  BIN_CHUNK = 0x004e4942;

/** @param {Uint8Array} bytes */
export function isGlb(bytes) {
  return bytes.length >= 12 && new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true) === MAGIC;
}

/** The JSON and the binary chunk of a GLB. Throws where it is none. @param {Uint8Array} bytes */
export function splitGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (!isGlb(bytes) || view.getUint32(8, true) > bytes.length)
    throw new Error('The file is no GLB, or its end is missing');
  let json,
    bin = new Uint8Array(0);
  for (let at = 12; at + 8 <= bytes.length;) {
    const length = view.getUint32(at, true),
      kind = view.getUint32(at + 4, true);
    if (length > bytes.length - at - 8) throw new Error('A part of the GLB is longer than the file');
    const chunk = bytes.subarray(at + 8, at + 8 + length);
    if (kind === JSON_CHUNK) json = parsed(chunk);
    else if (kind === BIN_CHUNK) bin = chunk;
    at += 8 + length;
  }
  if (!json) throw new Error('The GLB has no JSON');
  return {json, bin};
}

/** @param {Uint8Array} text */
function parsed(text) {
  try {
    return JSON.parse(new TextDecoder().decode(text));
  } catch (error) {
    throw new Error(`The JSON of the GLB is broken: ${/** @type {any} */ (error).message}`);
  }
}

/** @param {Uint8Array} bytes @param {number} filler */
function padded(bytes, filler) {
  const result = new Uint8Array(Math.ceil(bytes.length / 4) * 4).fill(filler);
  result.set(bytes);
  return result;
}

/** @param {any} json @param {Uint8Array} bin */
export function joinGlb(json, bin) {
  const chunks = [[JSON_CHUNK, padded(new TextEncoder().encode(JSON.stringify(json)), 0x20)]];
  if (bin.length > 0) chunks.push([BIN_CHUNK, padded(bin, 0)]);
  const size = chunks.reduce((sum, [, data]) => sum + 8 + data.length, 12);
  const result = new Uint8Array(size),
    view = new DataView(result.buffer);
  view.setUint32(0, MAGIC, true);
  view.setUint32(4, 2, true);
  view.setUint32(8, size, true);
  let at = 12;
  for (const [kind, data] of chunks) {
    view.setUint32(at, data.length, true);
    view.setUint32(at + 4, kind, true);
    result.set(data, at + 8);
    at += 8 + data.length;
  }
  return result;
}

const types = {png: 'image/png', jpg: 'image/jpeg', jpeg: 'image/jpeg', webp: 'image/webp', ktx2: 'image/ktx2'};

/**
 * A .gltf file with the files that it names, as one: they become data URIs, so that every buffer keeps its number.
 * @param {any} json @param {Record<string, Uint8Array>} resources  by URI
 */
export function withInside(json, resources) {
  const inside = (/** @type {any} */ thing) => {
    if (!(thing.uri in resources)) return thing;
    const type = types[thing.uri.split('.').pop().toLowerCase()] ?? 'application/octet-stream';
    return {...thing, uri: `data:${type};base64,${base64(resources[thing.uri])}`};
  };
  return joinGlb(
    {
      ...json,
      ...(json.buffers && {buffers: json.buffers.map(inside)}),
      ...(json.images && {images: json.images.map(inside)}),
    },
    new Uint8Array(0)
  );
}

/** @param {Uint8Array} bytes */
function base64(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}

/** The bytes of a GLB that are images. @param {Uint8Array} glb */
export function imageBytes(glb) {
  const {json} = splitGlb(glb);
  const views = new Set((json.images ?? []).map((image) => image.bufferView).filter((view) => view !== undefined));
  return [...views].reduce((sum, view) => sum + (json.bufferViews?.[view]?.byteLength ?? 0), 0);
}

/**
 * What a file comes to, without its images, which are the same in every version of a model.
 * @param {Uint8Array} bytes @param {number} images  how many of them are images
 * @returns {Promise<{size: number, zipped: number}>}
 */
export async function sizesOf(bytes, images) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream('gzip'));
  const zipped = (await new Response(stream).arrayBuffer()).byteLength;
  return {size: bytes.length - images, zipped: Math.max(0, zipped - images)};
}
