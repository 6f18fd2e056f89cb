/** The worker: reads a model, stores it in every way, measures. It answers {id, task, ...} by {id, result | error}. */

import {Logger, WebIO} from '@gltf-transform/core';
import {ALL_EXTENSIONS, EXTMeshoptCompression, KHRDracoMeshCompression} from '@gltf-transform/extensions';
import {draco, meshopt, prune, weld} from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import {MeshoptDecoder, MeshoptEncoder} from 'meshoptimizer';
import {loadTutte} from 'tutte-gltf';
import {loadEncoder} from 'tutte-gltf/encoder';
import {imageBytes, sizesOf, splitGlb} from './glb.js';
import {payloadsOf, timeDraco, timeMeshopt, timeTutte} from './times.js';

/** @type {any} */ let parts;
/** The model at hand, uncompressed, as a GLB with its polygons. @type {Uint8Array} */ let model;

/** Everything that takes time to load, once. */
async function load() {
  const wasm = async (/** @type {string} */ name) =>
    new Uint8Array(await (await fetch(new URL(name, import.meta.url))).arrayBuffer());
  const [decoder, encoder, tutte, tutteEncoder] = await Promise.all([
    wasm('draco_decoder_gltf.wasm').then((wasmBinary) => draco3d.createDecoderModule({wasmBinary})),
    wasm('draco_encoder.wasm').then((wasmBinary) => draco3d.createEncoderModule({wasmBinary})),
    loadTutte({workers: 0}),
    loadEncoder(),
    MeshoptDecoder.ready,
    MeshoptEncoder.ready,
  ]);
  const io = new WebIO()
    .setLogger(new Logger(Logger.Verbosity.ERROR))
    .registerExtensions(ALL_EXTENSIONS)
    .registerDependencies({
      'draco3d.decoder': decoder,
      'draco3d.encoder': encoder,
      'meshopt.decoder': MeshoptDecoder,
      'meshopt.encoder': MeshoptEncoder,
    });
  return {io, tutte, tutteEncoder, decoder};
}

const tasks = {
  /** Reads a model and gives it back as a GLB that any loader reads; and what else the page should know of it. */
  async open({glb}) {
    const {io, tutteEncoder} = await (parts ??= load());
    const {json} = splitGlb(glb);
    const used = json.extensionsUsed ?? [];
    model = used.includes('TUTTE_mesh_compression') ? tutteEncoder.decompress(glb) : glb;
    if (used.some((name) => others.includes(name))) model = await io.writeBinary(plain(await io.readBinary(model)));
    const hasWeights = /"WEIGHTS_\d/.test(JSON.stringify(json.meshes ?? []));
    return {glb: model, wasCompressed: model !== glb, hasWeights, ...(await sizesOf(model, imageBytes(model)))};
  },

  /** Stores the model in one of the ways. */
  async store({way, bits, choice}) {
    const all = await parts;
    const {bytes, warnings} = await ways[way](bits, all, choice);
    const shown = way === 'tutte' ? bytes : await all.io.writeBinary(plain(await all.io.readBinary(bytes)));
    return {bytes, warnings, shown, ...(await sizesOf(bytes, imageBytes(bytes))), ms: await timers[way](bytes, all)};
  },

  /** What the payloads of a compressed GLB consist of. */
  async describe({bytes}) {
    const {tutte} = await parts;
    const sections = new Map();
    let vertices = 0,
      inside = 0,
      whole = 0;
    for (const payload of payloadsOf(bytes)) {
      const description = await tutte.describe(payload.bytes);
      vertices += description.vertices;
      whole += payload.bytes.length;
      for (const {name, byteLength} of description.sections) {
        sections.set(name, (sections.get(name) ?? 0) + byteLength);
        inside += byteLength;
      }
    }
    if (whole > 0) sections.set('HEADER', whole - inside);
    return {sections, vertices};
  },
};

const ways = {
  /** `choice`: what only this encoder knows. */
  tutte(bits, {tutteEncoder}, choice) {
    const {glb, warnings} = tutteEncoder.compress(model, choice.lossless ? choice : {...tutteBits(bits), ...choice});
    return {bytes: glb, warnings};
  },

  draco: (bits, {io}) =>
    transformed(io, draco({method: 'edgebreaker', encodeSpeed: 0, decodeSpeed: 0, ...quantization(bits)})),

  meshopt: (bits, {io}) => transformed(io, meshopt({encoder: MeshoptEncoder, level: 'medium', ...quantization(bits)})),
};

function tutteBits(bits) {
  return {
    positionBits: bits.POSITION,
    normalBits: bits.NORMAL,
    texcoordBits: bits.TEXCOORD,
    colorBits: bits.COLOR,
    genericBits: bits.GENERIC,
  };
}

function quantization(bits) {
  return {
    quantizePosition: bits.POSITION,
    quantizeNormal: bits.NORMAL,
    quantizeTexcoord: bits.TEXCOORD,
    quantizeColor: bits.COLOR,
    quantizeGeneric: bits.GENERIC,
  };
}

/** The model as glTF-Transform has it, without polygons, through one more transform. */
async function transformed(io, transform) {
  const document = await io.readBinary(model);
  await document.transform(prune({keepAttributes: true, keepLeaves: true, keepSolidTextures: true}), weld(), transform);
  return {bytes: await io.writeBinary(document), warnings: []};
}

const timers = {
  tutte: (bytes, {tutte}) => timeTutte(bytes, tutte),
  draco: (bytes, {decoder}) => timeDraco(bytes, decoder),
  meshopt: (bytes) => timeMeshopt(bytes, MeshoptDecoder),
};

const others = [
  KHRDracoMeshCompression.EXTENSION_NAME,
  EXTMeshoptCompression.EXTENSION_NAME,
  'KHR_meshopt_compression',
];

/** Without compression. */
function plain(document) {
  for (const extension of document.getRoot().listExtensionsUsed()) {
    if (others.includes(extension.extensionName)) extension.dispose();
  }
  return document;
}

self.onmessage = async ({data: {id, task, ...rest}}) => {
  try {
    self.postMessage({id, result: await tasks[task](rest)});
  } catch (error) {
    self.postMessage({id, error: error instanceof Error ? error.message : String(error)});
  }
};
