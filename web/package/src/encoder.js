import {TutteError} from './error.js';
import {compile, compileInlined} from './modules.js';

/** The bits, which come first in tutte_compress_options (gltf_ext/c_abi_glb.h). */
const bits = ['positionBits', 'normalBits', 'texcoordBits', 'colorBits', 'genericBits'];
/** Its fields of 32 bits, in order; those that are names have their lists. */
const fields = [...bits, 'attributeCoder', 'profile', 'effort', 'polygons', 'fallback', 'grid', 'lossless'];
/** The bounds that follow, of 16 bytes each. */
const bounds = ['position', 'texcoord', 'color', 'generic'];
const boundsOffset = 4 * fields.length, optionsSize = boundsOffset + 16 * bounds.length;
/** @type {Record<string, Record<string, number>>} */
const choices = {
  attributeCoder: {auto: 0, draco: 1, tutte: 2},
  profile: {auto: -1, paper: 0, fast: 1, default: 2, small: 3},
  polygons: {auto: 0, fb: 1, ext: 2, both: 3},
  grid: {file: 0, mesh: 1},
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

/** @param {string} sentence @returns {never} */
function refuse(sentence) {
  throw new TutteError('INVALID_ARGUMENT', sentence);
}

/** A bound as [size, is it a part of the extent?]. @param {string} name @param {unknown} value @returns {[number, boolean]} */
function boundOf(name, value) {
  const relative = typeof value === 'string' && value.endsWith('%');
  const size = relative ? Number(value.slice(0, -1).trim() || NaN) / 100 : typeof value === 'number' ? value : NaN;
  if (size > 0 && size < (relative ? 1 : Infinity)) return [size, relative];
  return refuse(`the error of '${name}' cannot be '${value}': it is a number above 0, or one below 100 and a %`);
}

/** @param {DataView} memory @param {number} address @param {Record<string, unknown>} errors */
function writeBounds(memory, address, errors) {
  for (const name of Object.keys(errors)) {
    if (!bounds.includes(name)) refuse(`'${name}' has no error; there are ${bounds.join(', ')}`);
  }
  bounds.forEach((name, i) => {
    if (errors[name] === undefined) return;
    const [size, relative] = boundOf(name, errors[name]);
    memory.setFloat64(address + 16 * i, size, true);
    memory.setInt32(address + 16 * i + 8, Number(relative), true);
  });
}

/**
 * The options in the instance's memory, as far as they are given. The instance lives for one call, so nothing is freed.
 * @param {any} exports @param {Record<string, any>} options
 */
function writeOptions(exports, {errors = {}, ...options}) {
  for (const name of Object.keys(options)) {
    if (!fields.includes(name)) refuse(`the option '${name}' is unknown`);
  }
  if (errors === null || typeof errors !== 'object') refuse(`the option 'errors' cannot be '${errors}'`);
  if (options.lossless && (Object.keys(errors).length > 0 || bits.some((name) => options[name] !== undefined))) {
    refuse("the option 'lossless' goes with neither bits nor errors");
  }
  const address = exports.malloc(optionsSize);
  exports.tutte_default_options(address);
  const memory = new DataView(exports.memory.buffer);
  fields.forEach((name, i) => {
    const value = options[name];
    if (value === undefined) return;
    const number = name in choices ? choices[name][value] : Number(value);
    if (!Number.isInteger(number)) refuse(`the option '${name}' cannot be '${value}'`);
    memory.setInt32(address + 4 * i, number, true);
  });
  writeBounds(memory, address + boundsOffset, errors);
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
