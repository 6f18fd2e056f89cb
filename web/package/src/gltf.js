import {EXTENSION_NAME, TutteError} from './index.js';

const modes = new Set(
  ['TRIANGLES', 'POLYGON_LOOPS', 'POLYGON_LOOP_OFFSETS', 'POLYGON_INDEX_OFFSETS', 'DEGREES', 'ATTRIBUTE', 'WELD']);

/** @param {string} where @param {string} what @returns {never} */
function refuse(where, what, code = 'INVALID_JSON') {
  throw new TutteError(code, `${where}: ${what}`);
}

/** @param {any} object @param {string} name @param {string} where @param {number} least @param {number} [absent] */
function integer(object, name, where, least, absent) {
  const value = object[name] ?? absent;
  if (!Number.isSafeInteger(value) || value < least) refuse(`${where}/${name}`, 'this is no such integer');
  return value;
}

/** @type {import('./gltf.js').compressedView} */
export function compressedView(json, index) {
  const view = json.bufferViews?.[index];
  const object = view?.extensions?.[EXTENSION_NAME];
  if (object === undefined) return null;
  const where = `/bufferViews/${index}/extensions/${EXTENSION_NAME}`;
  if (object === null || typeof object !== 'object') refuse(where, 'this is no object');
  const mode = object.mode;
  if (!modes.has(mode)) refuse(`${where}/mode`, `the mode '${mode}' is unknown`, 'UNKNOWN_MODE');
  if ((mode === 'ATTRIBUTE') !== (object.attribute !== undefined)) refuse(where, "'attribute' goes with ATTRIBUTE only");
  const byteStride = integer(object, 'byteStride', where, 1);
  const strides = mode === 'ATTRIBUTE' ? [4, 8, 12, 16] : [1, 2, 4];
  if (!strides.includes(byteStride)) refuse(`${where}/byteStride`, `it is none of ${strides.join(', ')}`);
  const count = integer(object, 'count', where, 1);
  if (count > 0xFFFFFFFF) refuse(`${where}/count`, 'it is beyond 32 bits');
  if (view.byteLength !== count * byteStride) refuse(`/bufferViews/${index}/byteLength`, 'it is not count * byteStride');
  return {
    buffer: integer(object, 'buffer', where, 0),
    byteOffset: integer(object, 'byteOffset', where, 0, 0),
    byteLength: integer(object, 'byteLength', where, 1),
    byteStride, count, mode,
    ...(mode === 'ATTRIBUTE' ? {attribute: integer(object, 'attribute', where, 0)} : {}),
  };
}

/** @param {import('./gltf.js').CompressedView} view */
function payloadKey(view) {
  return `${view.buffer} ${view.byteOffset} ${view.byteLength}`;
}

/** Decodes the compressed buffer views of one glTF file, each payload once. */
export class CompressedViews {
  /**
   * @param {any} json  the file's JSON
   * @param {import('./index.js').Tutte | Promise<import('./index.js').Tutte>} tutte
   * @param {(buffer: number) => Promise<ArrayBuffer | ArrayBufferView>} loadBuffer
   */
  constructor(json, tutte, loadBuffer) {
    this.json = json;
    this.tutte = tutte;
    this.loadBuffer = loadBuffer;
    /** @type {Map<string, Promise<Map<number, Uint8Array>>>} */
    this.payloads = new Map();
  }

  /**
   * The decoded bytes of a buffer view, or null when it is an ordinary one. Never throws: errors reject.
   * @param {number} index
   * @returns {Promise<Uint8Array> | null}
   */
  load(index) {
    if (this.json.bufferViews?.[index]?.extensions?.[EXTENSION_NAME] === undefined) return null;
    return this.#load(index);
  }

  /** @param {number} index */
  async #load(index) {
    const view = /** @type {import('./gltf.js').CompressedView} */ (compressedView(this.json, index));
    const key = payloadKey(view);
    let payload = this.payloads.get(key);
    if (!payload) {
      payload = this.#decode(view);
      this.payloads.set(key, payload);
    }
    return /** @type {Uint8Array} */ ((await payload).get(index));
  }

  /** All arrays of the payload that a view names. @param {import('./gltf.js').CompressedView} view */
  async #decode(view) {
    const members = [];
    for (let index = 0; index < this.json.bufferViews.length; ++index) {
      const other = compressedView(this.json, index);
      if (other && payloadKey(other) === payloadKey(view)) members.push({index, view: other});
    }
    const [tutte, buffer] = await Promise.all([this.tutte, this.loadBuffer(view.buffer)]);
    const bytes = ArrayBuffer.isView(buffer)
      ? new Uint8Array(buffer.buffer, buffer.byteOffset, buffer.byteLength)
      : new Uint8Array(buffer);
    if (view.byteOffset + view.byteLength > bytes.length) {
      refuse(`/buffers/${view.buffer}`, 'the payload does not lie inside it');
    }
    const payload = bytes.subarray(view.byteOffset, view.byteOffset + view.byteLength);
    const arrays = await tutte.decode(payload, members.map((member) => member.view));
    return new Map(members.map((member, i) => [member.index, arrays[i]]));
  }
}
