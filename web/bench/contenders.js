// Decoders that are compared. Each takes the bytes that its own encoder made of one mesh, and gives triangle indices and
// attributes as typed arrays, which is what a loader needs. Runs in Node.js and in browsers.

/** @typedef {{name: string, attributes: {name: string, components: number, id?: number}[]}} Mesh */

/** The package's decoder. @param {any} instance @param {Uint8Array} payload @param {any[]} requests */
export function decodeTutte(instance, payload, requests) {
  return instance.decode(payload, requests);
}

/**
 * draco3d, used as three.js's DRACOLoader uses it.
 * @param {any} draco @param {Uint8Array} bytes @param {{components: number, id: number}[]} attributes
 */
export function decodeDraco(draco, bytes, attributes) {
  const decoder = new draco.Decoder(), mesh = new draco.Mesh();
  const status = decoder.DecodeArrayToMesh(bytes, bytes.length, mesh);
  if (!status.ok() || mesh.ptr === 0) throw new Error(status.error_msg());
  const size = 12 * mesh.num_faces(), address = draco._malloc(size);
  decoder.GetTrianglesUInt32Array(mesh, size, address);
  const arrays = [new Uint32Array(draco.HEAPF32.buffer, address, size / 4).slice()];
  draco._free(address);
  for (const {components, id} of attributes) {
    const attribute = decoder.GetAttributeByUniqueId(mesh, id);
    const length = 4 * mesh.num_points() * components, place = draco._malloc(length);
    decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, draco.DT_FLOAT32, length, place);
    arrays.push(new Float32Array(draco.HEAPF32.buffer, place, length / 4).slice());
    draco._free(place);
  }
  draco.destroy(mesh);
  draco.destroy(decoder);
  return arrays;
}

/**
 * meshoptimizer's decoder, on quantised data as EXT_meshopt_compression has it.
 * @param {any} meshopt @param {{mode: string, bytes: Uint8Array, count: number, stride: number}[]} streams
 */
export function decodeMeshopt(meshopt, streams) {
  return streams.map(({mode, bytes, count, stride}) => {
    const out = new Uint8Array(count * stride);
    meshopt.decodeGltfBuffer(out, count, stride, bytes, mode);
    return out;
  });
}

/** The best time of several runs in milliseconds, one of each in turn. @param {Record<string, () => unknown>} runs */
export function bestTimes(runs, seconds = 0.5) {
  /** @type {Record<string, number>} */
  const best = {};
  const until = performance.now() + 1000 * seconds * Object.keys(runs).length;
  for (let round = 0; round < 3 || performance.now() < until; ++round) {
    for (const [name, run] of Object.entries(runs)) {
      const start = performance.now();
      run();
      best[name] = Math.min(best[name] ?? Infinity, performance.now() - start);
    }
  }
  return best;
}
