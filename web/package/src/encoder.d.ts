import type {WasmSource} from './index.js';

/** A number above 0 in the attribute's units (positions: metres), or such as '0.01%' of its largest extent. */
export type ErrorBound = number | `${number}%`;

/** How to compress. Bits are 0 to 24 per component; 0: without loss. */
export interface EncodeOptions {
  /** Usually 14. */
  positionBits?: number;
  /** Of normals and tangents; usually 10. */
  normalBits?: number;
  /** Usually 12. */
  texcoordBits?: number;
  /** Usually 8. */
  colorBits?: number;
  /** Of custom attributes, and of morph targets of anything but positions; usually 12. */
  genericBits?: number;
  /** How far a component may be from the original; where given, this decides instead of the bits. */
  errors?: {position?: ErrorBound; texcoord?: ErrorBound; color?: ErrorBound; generic?: ErrorBound};
  /** Keep every bit of every attribute. Goes with neither bits nor errors. */
  lossless?: boolean;
  /** Whose positions are rounded alike, so that no cracks open between them; usually the file's. */
  grid?: 'file' | 'mesh';
  /** Who codes the attributes' numbers; usually whichever takes fewer bytes. */
  attributeCoder?: 'auto' | 'draco' | 'tutte';
  /** Of connectivity and attributes. */
  profile?: 'auto' | 'paper' | 'fast' | 'default' | 'small';
  /** How long to search for fewer bytes, 0 to 3. */
  effort?: number;
  /** How other programs find the polygons: FB_ngon_encoding, EXT_mesh_polygon, both, or as the input has them. */
  polygons?: 'auto' | 'fb' | 'ext' | 'both';
  /** Keep the uncompressed data too, for loaders without the extension. */
  fallback?: boolean;
}

/** Both methods work where they are called, which takes a while: call them in a worker. They throw TutteErrors. */
export interface Encoder {
  /** Compresses a GLB. `warnings` say what was left as it was, and why. */
  compress(glb: Uint8Array, options?: EncodeOptions): {glb: Uint8Array; warnings: string[]};
  /** A compressed GLB as a plain one, which every loader reads. */
  decompress(glb: Uint8Array): Uint8Array;
}

/** Loads the encoder, which is a module of its own. */
export function loadEncoder(options?: {wasm?: WasmSource}): Promise<Encoder>;
