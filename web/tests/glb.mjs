// GLB files taken apart and put together.

/** @param {Uint8Array} bytes @returns {{json: any, bin: Uint8Array}} */
export function readGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const jsonLength = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + jsonLength)));
  const at = 20 + jsonLength;
  const bin = at < bytes.length ? bytes.subarray(at + 8, at + 8 + view.getUint32(at, true)) : new Uint8Array();
  return {json, bin};
}

/** @param {any} json @param {Uint8Array} bin @returns {Uint8Array} */
export function writeGlb(json, bin) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const jsonLength = (text.length + 3) & ~3, binLength = (bin.length + 3) & ~3;
  const bytes = new Uint8Array(28 + jsonLength + binLength).fill(32, 20 + text.length, 20 + jsonLength);
  const view = new DataView(bytes.buffer);
  [0x46546C67, 2, bytes.length, jsonLength, 0x4E4F534A].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.set(text, 20);
  view.setUint32(20 + jsonLength, binLength, true);
  view.setUint32(24 + jsonLength, 0x004E4942, true);
  bytes.set(bin, 28 + jsonLength);
  return bytes;
}
