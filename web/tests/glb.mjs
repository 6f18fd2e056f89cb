// GLB files taken apart and put together, by the package's own code: the tests compare what it decodes with what the
// native command decodes, not how it reads containers.
import {joinGlb, splitGlb} from '../package/src/glb.js';

/** @param {Uint8Array} bytes @returns {{json: any, bin: Uint8Array}} */
export function readGlb(bytes) {
  const {json, bin} = splitGlb(bytes);
  return {json, bin: bin ?? new Uint8Array()};
}

/** @type {(json: any, bin: Uint8Array) => Uint8Array} */
export const writeGlb = joinGlb;
