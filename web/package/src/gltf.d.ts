import type {ArrayRequest, Tutte} from './index.js';

/** The extension object of a buffer view. */
export interface CompressedView extends ArrayRequest {
  buffer: number;
  byteOffset: number;
  byteLength: number;
}

/**
 * The extension object of buffer view `index` of a glTF file's JSON, or null when the view is an ordinary one. Throws a
 * TutteError when the object breaks a rule.
 */
export function compressedView(json: any, index: number): CompressedView | null;

/** Decodes the compressed buffer views of one glTF file, each payload once: what every loader plug-in is made of. */
export class CompressedViews {
  constructor(
    json: any,
    tutte: Tutte | Promise<Tutte>,
    loadBuffer: (buffer: number) => Promise<ArrayBuffer | ArrayBufferView>,
  );
  /** The decoded bytes of a buffer view, or null when it is an ordinary one. */
  load(index: number): Promise<Uint8Array> | null;
}
