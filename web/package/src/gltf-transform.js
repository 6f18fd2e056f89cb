import {Extension, Format, GLB_BUFFER, PropertyType} from '@gltf-transform/core';

import {loadEncoder} from './encoder.js';
import {EXTENSION_NAME, TutteError} from './index.js';
import {compressedView} from './gltf.js';
import {joinGlb, splitGlb} from './glb.js';
import {EXTMeshPolygon, FBNgonEncoding} from './gltf-transform-polygons.js';
import {Instance} from './instance.js';
import {Modules} from './modules.js';

export {EXTMeshPolygon, FBNgonEncoding, MeshPolygon, NgonMark} from './gltf-transform-polygons.js';

/** @type {import('./gltf-transform.js').loadDependencies} */
export async function loadDependencies() {
  const modules = new Modules({});
  const [plain, draco, encoder] = await Promise.all([modules.get(false), modules.get(true), loadEncoder()]);
  const instances = [new Instance(plain, false), new Instance(draco, true)];
  return {
    'tutte.decoder': {
      decode(payload, requests) {
        try {
          return instances[0].decode(payload, requests);
        } catch (error) {
          if (/** @type {any} */ (error)?.code !== 'NOT_BUILT') throw error;
        }
        return instances[1].decode(payload, requests);
      },
    },
    'tutte.encoder': encoder,
  };
}

/** Buffers of a file's JSON and what is in them. @param {any} jsonDoc @param {number} index */
function bufferBytes({json, resources}, index) {
  const definition = json.buffers?.[index];
  const bytes = definition && resources[definition.uri ?? GLB_BUFFER];
  if (!bytes) throw new TutteError('INVALID_JSON', `/buffers/${index}: its bytes are missing`);
  return /** @type {Uint8Array} */ (bytes);
}

/** TUTTE_mesh_compression. While it is in use, documents are written compressed. */
export class TutteMeshCompression extends Extension {
  static EXTENSION_NAME = EXTENSION_NAME;
  extensionName = EXTENSION_NAME;
  prereadTypes = [PropertyType.BUFFER];
  readDependencies = ['tutte.decoder'];
  writeDependencies = ['tutte.encoder'];

  /** @type {import('./gltf-transform.js').SyncDecoder | undefined} */
  #decoder;
  /** @type {import('./encoder.js').Encoder | undefined} */
  #encoder;
  /** @type {import('./encoder.js').EncodeOptions} */
  #options = {};
  /** Placeholder or fallback buffer -> the buffer with its payloads. @type {Map<number, number>} */
  #replacements = new Map();

  /** @param {import('./encoder.js').EncodeOptions} options */
  setEncoderOptions(options) {
    this.#options = options;
    return this;
  }

  /** @param {string} key @param {any} dependency */
  install(key, dependency) {
    if (key === 'tutte.decoder') this.#decoder = dependency;
    if (key === 'tutte.encoder') this.#encoder = dependency;
    return this;
  }

  /** @param {any} context */
  preread(context) {
    const decoder = this.#decoder;
    if (!decoder) throw new Error(`[${EXTENSION_NAME}] Please install the dependency 'tutte.decoder'.`);
    const {jsonDoc} = context, views = jsonDoc.json.bufferViews ?? [];
    /** @type {Map<string, {index: number, view: import('./gltf.js').CompressedView}[]>} */
    const payloads = new Map();
    for (let index = 0; index < views.length; ++index) {
      const view = compressedView(jsonDoc.json, index);
      if (!view) continue;
      const key = `${view.buffer} ${view.byteOffset} ${view.byteLength}`;
      payloads.set(key, [...payloads.get(key) ?? [], {index, view}]);
      this.#replacements.set(views[index].buffer, view.buffer);
    }
    for (const members of payloads.values()) {
      const {buffer, byteOffset, byteLength} = members[0].view;
      const bytes = bufferBytes(jsonDoc, buffer);
      if (byteOffset + byteLength > bytes.length) {
        throw new TutteError('INVALID_JSON', `/buffers/${buffer}: the payload does not lie inside it`);
      }
      const arrays = decoder.decode(bytes.subarray(byteOffset, byteOffset + byteLength), members.map(({view}) => view));
      members.forEach(({index}, i) => { context.bufferViews[index] = arrays[i]; });
    }
    return this;
  }

  /** Accessors move from the placeholders, which nobody needs any more. @param {any} context */
  read(context) {
    for (const [from, to] of this.#replacements) {
      const placeholder = context.buffers[from];
      for (const parent of placeholder.listParents()) {
        if (parent.propertyType === PropertyType.ACCESSOR) parent.swap(placeholder, context.buffers[to]);
      }
      placeholder.dispose();
    }
    this.#replacements.clear();
    return this;
  }

  /**
   * Compresses the file, which is complete by then.
   * @param {any} context
   */
  write(context) {
    const encoder = this.#encoder;
    if (!encoder) throw new Error(`[${EXTENSION_NAME}] Please install the dependency 'tutte.encoder'.`);
    const {jsonDoc} = context, {json, resources} = jsonDoc;
    for (const list of ['extensionsUsed', 'extensionsRequired']) {
      json[list] = json[list]?.filter((/** @type {string} */ name) => name !== EXTENSION_NAME);
      if (json[list]?.length === 0) delete json[list];
    }
    const {glb, uri} = gatherBuffers(json, resources);
    const result = encoder.compress(glb, this.#options);
    for (const warning of result.warnings) this.document.getLogger().warn(`[${EXTENSION_NAME}] ${warning}`);
    const compressed = splitGlb(result.glb);
    for (const name of Object.keys(json)) delete json[name];
    Object.assign(json, compressed.json);
    if (!compressed.bin) return this;
    if (context.options.format !== Format.GLB) json.buffers[0].uri = uri;
    resources[context.options.format === Format.GLB ? GLB_BUFFER : uri] = compressed.bin;
    return this;
  }
}

/**
 * All buffers of a file as one GLB; the resources lose them.
 * @param {any} json @param {Record<string, Uint8Array>} resources
 */
function gatherBuffers(json, resources) {
  /** @type {Uint8Array[]} */
  const parts = [];
  /** @type {number[]} */
  const starts = [];
  let size = 0, uri = 'buffer.bin';
  for (const buffer of json.buffers ?? []) {
    const bytes = resources[buffer.uri ?? GLB_BUFFER] ?? new Uint8Array(buffer.byteLength ?? 0);
    if (buffer.uri && parts.length === 0) uri = buffer.uri;
    delete resources[buffer.uri ?? GLB_BUFFER];
    starts.push(size);
    parts.push(bytes);
    size = (size + bytes.length + 7) & ~7;
  }
  const bin = new Uint8Array(size);
  parts.forEach((part, i) => bin.set(part, starts[i]));
  for (const view of json.bufferViews ?? []) {
    view.byteOffset = (view.byteOffset ?? 0) + starts[view.buffer];
    view.buffer = 0;
  }
  if (json.buffers?.length) json.buffers = [{byteLength: size}];
  return {glb: joinGlb(json, bin), uri};
}

/** @type {import('./gltf-transform.js').tutte} */
export function tutte(options = {}) {
  return (document) => {
    // The last extension of a document is the last to write, when all others have.
    document.getRoot().listExtensionsUsed().find((used) => used.extensionName === EXTENSION_NAME)?.dispose();
    document.createExtension(TutteMeshCompression).setRequired(!options.fallback).setEncoderOptions(options);
  };
}

/** All three, for `io.registerExtensions()`. */
export const TutteExtensions = [FBNgonEncoding, EXTMeshPolygon, TutteMeshCompression];
