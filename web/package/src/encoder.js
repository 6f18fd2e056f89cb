import {TutteError} from './error.js';
import {compile, compileInlined} from './modules.js';

/** Fields of tutte_compress_options (gltf_ext/c_abi_glb.h), in order; those that are names have their lists. */
const fields = [
  'positionBits', 'normalBits', 'texcoordBits', 'colorBits', 'genericBits', 'attributeCoder', 'profile',
  'effort', 'polygons', 'fallback'];
/** @type {Record<string, Record<string, number>>} */
const choices = {
  attributeCoder: {auto: 0, draco: 1, tutte: 2},
  profile: {auto: -1, paper: 0, fast: 1, default: 2, small: 3},
  polygons: {auto: 0, fb: 1, ext: 2, both: 3},
};

/** @type {Promise<WebAssembly.Module> | undefined} */
let inlined;

/** @type {import('./encoder.js').loadEncoder} */
export async function loadEncoder(options = {}) {
  const module = options.wasm === undefined
    ? await (inlined ??= import('../wasm/encoder.js').then(compileInlined))
    : await compile(options.wasm);
  return {
    compress: (glb, choice = {}) => run(module, (exports, address, size, place) =>
      exports.tutte_compress_glb(address, size, writeOptions(exports, choice), place), glb),
    decompress: (glb) => run(module, (exports, address, size, place) =>
      exports.tutte_decompress_glb(address, size, place), glb).glb,
  };
}

/**
 * The options in the instance's memory, as far as they are given. The instance lives for one call, so nothing is freed.
 * @param {any} exports @param {Record<string, any>} options
 */
function writeOptions(exports, options) {
  for (const name of Object.keys(options)) {
    if (!fields.includes(name)) throw new TutteError('INVALID_ARGUMENT', `the option '${name}' is unknown`);
  }
  const address = exports.malloc(4 * fields.length);
  exports.tutte_default_options(address);
  const words = new Int32Array(exports.memory.buffer, address, fields.length);
  fields.forEach((name, i) => {
    const value = options[name];
    if (value === undefined) return;
    const number = name in choices ? choices[name][value] : Number(value);
    if (!Number.isInteger(number)) throw new TutteError('INVALID_ARGUMENT', `the option '${name}' cannot be '${value}'`);
    words[i] = number;
  });
  return address;
}

/**
 * Calls a function of a fresh instance that makes a file of a file.
 * @param {WebAssembly.Module} module
 * @param {(exports: any, address: number, size: number, place: number) => number} call
 * @param {Uint8Array} input
 */
function run(module, call, input) {
  const exports = /** @type {any} */ (new WebAssembly.Instance(module, {}).exports);
  exports._initialize();
  const address = exports.malloc(input.length + 1), place = exports.malloc(4);
  if (address === 0 || place === 0) throw new TutteError('OUT_OF_MEMORY', 'the file is too large for WebAssembly');
  new Uint8Array(exports.memory.buffer, address, input.length).set(input);
  let status;
  try {
    status = call(exports, address, input.length, place);
  } catch (error) {
    if (error instanceof TutteError) throw error;
    throw new TutteError('STOPPED', `the encoder stopped (${error})`);
  }
  const file = new Uint32Array(exports.memory.buffer, place, 1)[0];
  const text = textAt(exports, exports.tutte_file_text(file));
  if (status !== 0) throw TutteError.ofStatus(status, text);
  const glb = new Uint8Array(exports.memory.buffer, exports.tutte_file_bytes(file), exports.tutte_file_size(file)).slice();
  return {glb, warnings: text.split('\n').filter((line) => line !== '')};
}

/** @param {any} exports @param {number} address  of a text that ends with 0 */
function textAt(exports, address) {
  const bytes = new Uint8Array(exports.memory.buffer, address);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}
