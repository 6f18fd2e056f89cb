import {TutteError} from './error.js';

/** The arrays of the C interface that the extension's modes name (codec/c_abi.h). @type {Record<string, number>} */
const arrays = {
  TRIANGLES: 16, POLYGON_INDEX_OFFSETS: 17, POLYGON_LOOPS: 18, POLYGON_LOOP_OFFSETS: 19, DEGREES: 20, WELD: 21,
};
const sections = ['CONNECTIVITY', 'SEAMS', 'GROUPS', 'RINGS', 'TRIANGULATION', 'ATTRIBUTES'];
const notAvailable = -102, notBuilt = -103;
const dracoCoder = 0;

/** An instance whose memory has grown beyond this is thrown away after use, for memory never shrinks. */
const mostBytesKept = 256 << 20;

/**
 * One instance of a WebAssembly module, replaced by a fresh one after anything that could have hurt it. Every method is
 * synchronous.
 */
export class Instance {
  /**
   * @param {WebAssembly.Module} module
   * @param {boolean} draco  whether the module has Draco
   */
  constructor(module, draco) {
    this.module = module;
    this.draco = draco;
    /** @type {any} */
    this.exports = null;
  }

  #start() {
    const {exports} = new WebAssembly.Instance(this.module, {});
    /** @type {any} */ (exports)._initialize();
    this.exports = exports;
  }

  /** @param {(exports: any) => any} work */
  #guarded(work) {
    try {
      if (!this.exports) this.#start();
      return work(this.exports);
    } catch (error) {
      if (error instanceof TutteError) throw error;
      this.exports = null;
      throw new TutteError('STOPPED', `TUTTE_mesh_compression: the decoder stopped (${error})`);
    } finally {
      if (this.exports && this.exports.memory.buffer.byteLength > mostBytesKept) this.exports = null;
    }
  }

  /**
   * The arrays that buffer views ask for, in their order, each in a buffer of its own.
   * @param {Uint8Array} payload
   * @param {readonly import('./index.js').ArrayRequest[]} requests
   * @returns {Uint8Array[]}
   */
  decode(payload, requests) {
    return this.#guarded((exports) => new Session(exports, this.draco).run((session) => session.decode(payload, requests)));
  }

  /**
   * What a payload holds, read from its header and its attributes' descriptions.
   * @param {Uint8Array} payload
   * @returns {import('./index.js').PayloadDescription}
   */
  describe(payload) {
    return this.#guarded((exports) => new Session(exports, this.draco).run((session) => session.describe(payload)));
  }
}

/** @param {string} code @param {string} sentence */
function refusal(code, sentence) {
  return new TutteError(code, `TUTTE_mesh_compression: ${sentence}`);
}

/** The memory and handles of one call; all are given back at its end. */
class Session {
  /** @param {any} exports @param {boolean} draco */
  constructor(exports, draco) {
    this.exports = exports;
    this.draco = draco;
    /** @type {(() => void)[]} */
    this.releases = [];
  }

  /** @template T @param {(session: Session) => T} work @returns {T} */
  run(work) {
    try {
      const result = work(this);
      this.#release();
      return result;
    } catch (error) {
      if (error instanceof TutteError) this.#release();  // after anything else the instance is thrown away
      throw error;
    }
  }

  #release() {
    while (this.releases.length > 0) this.releases.pop()?.();
  }

  /** @param {number} status */
  check(status) {
    if (status >= 0) return status;
    throw TutteError.ofStatus(status, this.text(this.exports.tutte_describe(status)));
  }

  /** @param {number} size */
  allocate(size) {
    const address = this.exports.malloc(Math.max(size, 1));
    if (address === 0) this.check(-11);
    this.releases.push(() => this.exports.free(address));
    return address >>> 0;
  }

  /** @param {Uint8Array} bytes */
  copyIn(bytes) {
    const address = this.allocate(bytes.length);
    new Uint8Array(this.exports.memory.buffer, address, bytes.length).set(bytes);
    return address;
  }

  /** @param {number} address @param {number} count */
  words(address, count) {
    return new Uint32Array(this.exports.memory.buffer, address, count);
  }

  /** @param {number} address  of a text that ends with 0 */
  text(address) {
    const bytes = new Uint8Array(this.exports.memory.buffer, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)).slice());
  }

  /** @param {number} address @param {number} size */
  mesh(address, size) {
    const place = this.allocate(4);
    this.check(this.exports.tutte_decode_payload(address, size, 0, place));
    const mesh = this.words(place, 1)[0];
    this.releases.push(() => this.exports.tutte_free(mesh));
    return mesh;
  }

  /** @param {number} mesh @param {number} address @param {number} size */
  attributes(mesh, address, size) {
    const place = this.allocate(4);
    this.check(this.exports.tutte_decode_attributes(mesh, address, size, place));
    const attributes = this.words(place, 1)[0];
    this.releases.push(() => this.exports.tutte_free_attributes(attributes));
    return attributes;
  }

  /** @param {Uint8Array} payload @param {readonly import('./index.js').ArrayRequest[]} requests */
  decode(payload, requests) {
    const address = this.copyIn(payload);
    this.#checkCounts(address, payload.length, requests);
    const wantsAttributes = requests.some((request) => request.mode === 'ATTRIBUTE');
    if (wantsAttributes && !this.draco) this.#refuseDraco(payload, address);
    const mesh = this.mesh(address, payload.length);
    const attributes = wantsAttributes ? this.attributes(mesh, address, payload.length) : 0;
    return requests.map((request) => this.#read(mesh, attributes, request));
  }

  /** Before the mesh is decoded in vain. The section's first byte names the coder. */
  #refuseDraco(/** @type {Uint8Array} */ payload, /** @type {number} */ address) {
    const {byteOffset, byteLength} = this.section(address, payload.length, sections.indexOf('ATTRIBUTES'));
    if (byteLength > 0 && payload[byteOffset] === dracoCoder) this.check(notBuilt);
  }

  /** Before any memory is taken: what the header claims against what the JSON declares. */
  #checkCounts(/** @type {number} */ address, /** @type {number} */ size,
      /** @type {readonly import('./index.js').ArrayRequest[]} */ requests) {
    const counts = this.counts(address, size);
    for (const {mode, count} of requests) {
      const fits = {
        TRIANGLES: count === 3 * counts.triangles,
        POLYGON_LOOPS: count <= counts.corners + counts.faces,
        POLYGON_LOOP_OFFSETS: count <= counts.faces,
        POLYGON_INDEX_OFFSETS: count <= counts.faces,
        DEGREES: count === counts.faces,
        ATTRIBUTE: count === counts.wedges,
        WELD: count === counts.wedges,
      }[mode];
      if (fits === undefined) throw refusal('UNKNOWN_MODE', `the mode '${mode}' is unknown`);
      if (!fits) throw refusal('COUNT_MISMATCH', `the payload does not have ${count} elements of mode ${mode}`);
    }
  }

  /** @param {number} mesh @param {number} attributes @param {import('./index.js').ArrayRequest} request */
  #read(mesh, attributes, {mode, attribute = 0, byteStride, count}) {
    const size = count * byteStride;
    const out = this.allocate(size);
    const read = mode === 'ATTRIBUTE'
      ? this.exports.tutte_read_attribute(attributes, attribute, byteStride, out, size)
      : this.exports.tutte_read(mesh, arrays[mode], byteStride, out, count);
    const elements = this.check(Number(read));
    if (elements !== (mode === 'ATTRIBUTE' ? size : count)) {
      throw refusal('COUNT_MISMATCH', `the payload does not have ${count} elements of mode ${mode}`);
    }
    const bytes = new Uint8Array(this.exports.memory.buffer, out, size).slice();
    this.releases.pop()?.();
    return bytes;
  }

  /** @param {number} address @param {number} size */
  counts(address, size) {
    const place = this.allocate(32);
    this.check(this.exports.tutte_peek_counts(address, size, place));
    const [vertices, wedges, faces, corners, triangles, groups, attributes] = this.words(place, 8);
    return {vertices, wedges, faces, corners, triangles, groups, attributes};
  }

  /** @param {Uint8Array} payload */
  describe(payload) {
    const address = this.copyIn(payload);
    const counts = this.counts(address, payload.length);
    const found = sections.map((name, number) => ({name, ...this.section(address, payload.length, number)}));
    return {...counts, sections: found.filter((section) => section.byteLength > 0)};
  }

  /** Where a section is; of length 0 when the payload does not have it. */
  section(/** @type {number} */ address, /** @type {number} */ size, /** @type {number} */ number) {
    const place = this.allocate(8);
    const status = this.exports.tutte_find_section(address, size, number, place, place + 4);
    if (status === notAvailable) return {byteOffset: 0, byteLength: 0};
    this.check(status);
    const [byteOffset, byteLength] = this.words(place, 2);
    return {byteOffset, byteLength};
  }
}
