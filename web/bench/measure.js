// One model through all decoders, in Node.js or a browser.
import {bestTimes, decodeDraco, decodeMeshopt, decodeTutte} from './contenders.js';

/** @param {Uint8Array[]} arrays */
async function hashOf(arrays) {
  const all = new Uint8Array(arrays.reduce((sum, array) => sum + array.length, 0));
  arrays.reduce((at, array) => (all.set(array, at), at + array.length), 0);
  const digest = await crypto.subtle.digest('SHA-256', all);
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, '0')).join('');
}

/** @param {any} input  of inputs.mjs @param {{instance: any, draco: any, meshopt: any}} decoders @param {number} seconds */
export async function measure(input, {instance, draco, meshopt}, seconds) {
  const runs = {
    tutte: () => decodeTutte(instance, input.tutte.payload, input.tutte.requests),
    draco10: () => decodeDraco(draco, input.draco10.bytes, input.draco10.attributes),
    draco7: () => decodeDraco(draco, input.draco7.bytes, input.draco7.attributes),
    meshopt: () => decodeMeshopt(meshopt, input.meshopt),
  };
  return {times: bestTimes(runs, seconds), hash: await hashOf(runs.tutte()), expected: await hashOf(input.expected)};
}
