import {TutteError} from './error.js';
import {Host} from './host.js';
import {Modules} from './modules.js';
import {Pool} from './pool.js';

export {TutteError};

/** The extension's name in glTF files. */
export const EXTENSION_NAME = 'TUTTE_mesh_compression';

/** Shorter payloads are decoded where they are: a worker's answer would take longer. */
const leastBytesForWorkers = 2000;

/** @type {import('./index.js').loadTutte} */
export async function loadTutte(options = {}) {
  const modules = new Modules(options);
  await modules.get(false);
  return new Decoder(modules, options.workers ?? usualWorkers());
}

function usualWorkers() {
  if (typeof Worker !== 'function' || typeof navigator === 'undefined') return 0;
  return Math.max(1, Math.min(4, (navigator.hardwareConcurrency ?? 2) - 1));
}

class Decoder {
  /** @type {Pool | null} */
  #pool;
  /** @type {Host} */
  #host;

  /** @param {Modules} modules @param {number} workers */
  constructor(modules, workers) {
    const moduleOf = (/** @type {boolean} */ draco) => modules.get(draco);
    this.#host = new Host(moduleOf);
    this.#pool = workers > 0 ? new Pool(workers, moduleOf) : null;
  }

  /** @param {Uint8Array} payload @param {readonly import('./index.js').ArrayRequest[]} requests */
  async decode(payload, requests) {
    if (this.#pool && payload.length >= leastBytesForWorkers) {
      try {
        return await this.#pool.call('decode', [payload.slice(), requests]);
      } catch (error) {
        if (/** @type {any} */ (error)?.code !== 'NO_WORKERS') throw error;
        this.#pool = null;
      }
    }
    return this.#host.call('decode', [payload, requests]);
  }

  /** @param {Uint8Array} payload */
  async describe(payload) {
    return this.#host.call('describe', [payload]);
  }

  dispose() {
    this.#pool?.dispose();
    this.#pool = null;
  }
}
