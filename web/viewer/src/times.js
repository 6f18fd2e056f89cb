/** How long it takes to decode a file's meshes with each codec, without the rest of a loader. */

import {compressedView} from 'tutte-gltf/gltf';
import {splitGlb} from './glb.js';

const leastMs = 4; // browsers' clocks are coarse
const leastRuns = 5; // the first ones run code that the browser has not optimised yet

/** The best time of several runs, in milliseconds. @param {() => unknown} work */
async function best(work, budget = 400) {
  let shortest = Infinity,
    count = 1,
    runs = 0;
  for (const end = performance.now() + budget; performance.now() < end || runs < leastRuns;) {
    const start = performance.now();
    for (let run = 0; run < count; ++run) await work();
    const spent = performance.now() - start;
    if (spent < leastMs && count < 1e4) {
      count *= 2;
      continue;
    }
    shortest = Math.min(shortest, spent / count);
    ++runs;
  }
  return shortest;
}

/** @param {Uint8Array} glb @param {any} tutte */
export async function timeTutte(glb, tutte) {
  const payloads = payloadsOf(glb);
  return best(async () => {
    for (const {bytes, views} of payloads) await tutte.decode(bytes, views);
  });
}

/** Every payload of a compressed file, with the views that it decodes to. @param {Uint8Array} glb */
export function payloadsOf(glb) {
  const {json, bin} = splitGlb(glb),
    payloads = new Map();
  (json.bufferViews ?? []).forEach((_, index) => {
    const view = compressedView(json, index);
    if (!view) return;
    const {byteOffset, byteLength} = view;
    if (!payloads.has(byteOffset))
      payloads.set(byteOffset, {bytes: bin.slice(byteOffset, byteOffset + byteLength), views: []});
    payloads.get(byteOffset).views.push(view);
  });
  return [...payloads.values()];
}

/** @param {Uint8Array} glb @param {any} decoder  meshoptimizer's */
export async function timeMeshopt(glb, decoder) {
  const {json, bin} = splitGlb(glb);
  const views = json.bufferViews.map((view) => view.extensions?.EXT_meshopt_compression).filter(Boolean);
  return best(() => {
    for (const {byteOffset = 0, byteLength, byteStride, count, mode, filter} of views) {
      const target = new Uint8Array(count * byteStride);
      decoder.decodeGltfBuffer(
        target,
        count,
        byteStride,
        bin.subarray(byteOffset, byteOffset + byteLength),
        mode,
        filter
      );
    }
  });
}

/** @param {Uint8Array} glb @param {any} draco  its decoder's module */
export async function timeDraco(glb, draco) {
  const {json, bin} = splitGlb(glb),
    meshes = new Map();
  for (const {primitives} of json.meshes ?? []) {
    for (const {attributes, extensions} of primitives) {
      const coded = extensions?.KHR_draco_mesh_compression;
      if (coded)
        meshes.set(
          coded.bufferView,
          Object.entries(coded.attributes).map(([name, id]) => ({id, accessor: json.accessors[attributes[name]]}))
        );
    }
  }
  return best(() => {
    for (const [view, attributes] of meshes) {
      const {byteOffset = 0, byteLength} = json.bufferViews[view];
      decodeDraco(draco, bin.subarray(byteOffset, byteOffset + byteLength), attributes);
    }
  });
}

/** As loaders do: the triangles and every attribute as arrays of their own. */
function decodeDraco(draco, bytes, attributes) {
  const decoder = new draco.Decoder(),
    buffer = new draco.DecoderBuffer(),
    mesh = new draco.Mesh();
  buffer.Init(bytes, bytes.length);
  const status = decoder.DecodeBufferToMesh(buffer, mesh);
  if (!status.ok()) throw new Error(`Draco: ${status.error_msg()}`);
  const types = {
    5120: [draco.DT_INT8, 1],
    5121: [draco.DT_UINT8, 1],
    5122: [draco.DT_INT16, 2],
    5123: [draco.DT_UINT16, 2],
    5125: [draco.DT_UINT32, 4],
    5126: [draco.DT_FLOAT32, 4],
  };
  copiedOut(draco, 12 * mesh.num_faces(), (size, at) => decoder.GetTrianglesUInt32Array(mesh, size, at));
  for (const {id, accessor} of attributes) {
    const attribute = decoder.GetAttributeByUniqueId(mesh, id),
      [type, width] = types[accessor.componentType];
    copiedOut(draco, mesh.num_points() * attribute.num_components() * width, (size, at) =>
      decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, type, size, at)
    );
  }
  for (const thing of [mesh, buffer, decoder]) draco.destroy(thing);
}

/** @param {any} draco @param {number} size @param {(size: number, at: number) => void} fill */
function copiedOut(draco, size, fill) {
  const at = draco._malloc(size);
  fill(size, at);
  const copy = draco.HEAPU8.slice(at, at + size);
  draco._free(at);
  return copy;
}
