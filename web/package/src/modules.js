import {TutteError} from './error.js';

/** @typedef {import('./index.js').WasmSource} WasmSource */

/** @param {string} base64 */
function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** @param {string | URL} url @returns {Promise<WebAssembly.Module>} */
async function compileFrom(url) {
  const response = await fetch(url);
  if (!response.ok) throw new TutteError('WASM', `the decoder could not be loaded from ${url}: ${response.status}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

/**
 * @param {WasmSource} source  a string is a URL
 * @returns {Promise<WebAssembly.Module>}
 */
export async function compile(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (typeof source === 'string' || source instanceof URL) return compileFrom(source);
  return WebAssembly.compile(source);
}

/** What a file of the folder wasm holds. @param {{default: string}} inlined */
export function compileInlined(inlined) {
  return WebAssembly.compile(bytesOf(inlined.default));
}

/** The two builds of the decoder, each compiled once and only when it is needed. */
export class Modules {
  /** @param {{wasm?: WasmSource, dracoWasm?: WasmSource}} sources  instead of those inside the package */
  constructor(sources) {
    this.sources = sources;
    /** @type {Promise<WebAssembly.Module> | undefined} */
    this.plain = undefined;
    /** @type {Promise<WebAssembly.Module> | undefined} */
    this.draco = undefined;
  }

  /** The module without Draco, or with it. @param {boolean} draco @returns {Promise<WebAssembly.Module>} */
  get(draco) {
    if (draco) return this.draco ??= this.#load(this.sources.dracoWasm, () => import('../wasm/decoder-draco.js'));
    return this.plain ??= this.#load(this.sources.wasm, () => import('../wasm/decoder.js'));
  }

  /** @param {WasmSource | undefined} source @param {() => Promise<{default: string}>} inlined */
  async #load(source, inlined) {
    return source === undefined ? compileInlined(await inlined()) : compile(source);
  }
}
