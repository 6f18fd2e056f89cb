// The GLB container.

/** @param {Uint8Array} bytes @returns {{json: any, bin: Uint8Array | null}} */
export function splitGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const jsonEnd = 20 + view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, jsonEnd)));
  if (jsonEnd + 8 > bytes.length) return {json, bin: null};
  return {json, bin: bytes.slice(jsonEnd + 8, jsonEnd + 8 + view.getUint32(jsonEnd, true))};
}

/** @param {any} json @param {Uint8Array} bin @returns {Uint8Array} */
export function joinGlb(json, bin) {
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
