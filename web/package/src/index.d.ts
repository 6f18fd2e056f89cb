/** The extension's name in glTF files. */
export const EXTENSION_NAME: 'TUTTE_mesh_compression';

/** The array that a compressed buffer view stands for. */
export type Mode =
  | 'TRIANGLES' | 'POLYGON_LOOPS' | 'POLYGON_LOOP_OFFSETS' | 'POLYGON_INDEX_OFFSETS' | 'DEGREES' | 'ATTRIBUTE' | 'WELD';

/** What the extension object of a buffer view says about its array. */
export interface ArrayRequest {
  mode: Mode;
  /** With mode ATTRIBUTE: which one. */
  attribute?: number;
  /** Bytes per element. */
  byteStride: number;
  /** Elements. */
  count: number;
}

/** Where the bytes of a section lie in a payload. */
export interface PayloadSection {
  name: 'CONNECTIVITY' | 'SEAMS' | 'GROUPS' | 'RINGS' | 'TRIANGULATION' | 'ATTRIBUTES';
  byteOffset: number;
  byteLength: number;
}

/** How large the mesh of a payload is. */
export interface PayloadDescription {
  vertices: number;
  /** glTF's vertices: a vertex on a seam has several. */
  wedges: number;
  faces: number;
  corners: number;
  triangles: number;
  /** glTF's primitives. */
  groups: number;
  attributes: number;
  sections: PayloadSection[];
}

/** Where the decoder comes from: a URL, its bytes, or a compiled module. */
export type WasmSource = string | URL | BufferSource | WebAssembly.Module;

export interface LoadOptions {
  /**
   * How many workers may decode at once; 0: decode where decode() is called. Usually one less than the machine has
   * processors, at most 4; in Node.js 0. Workers start when there is work for them. Where they cannot (a page with
   * another origin than the package's), payloads are decoded where decode() is called.
   */
  workers?: number;
  /** Instead of the module inside the package: `decoder.wasm`. */
  wasm?: WasmSource;
  /** Instead of the module inside the package: `decoder-draco.wasm`, loaded when a payload needs it. */
  dracoWasm?: WasmSource;
}

export interface Tutte {
  /**
   * Decodes a payload and gives the arrays that buffer views ask for, in their order, each in a buffer of its own.
   * Any bytes may be passed; what is wrong with them is a TutteError.
   */
  decode(payload: Uint8Array, requests: readonly ArrayRequest[]): Promise<Uint8Array[]>;
  /** What a payload holds and where, without decoding it. */
  describe(payload: Uint8Array): Promise<PayloadDescription>;
  /** Stops the workers. Nothing can be decoded by them afterwards, but decode() still works. */
  dispose(): void;
}

/** Loads the decoder. */
export function loadTutte(options?: LoadOptions): Promise<Tutte>;

/** Why a payload, or the JSON that describes it, was refused. */
export class TutteError extends Error {
  constructor(code: string, message: string);
  /** A name to compare, such as CHECKSUM, TRUNCATED, UNKNOWN_MODE, OUT_OF_MEMORY. */
  readonly code: string;
}
