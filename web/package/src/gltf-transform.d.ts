import type {Accessor, Document, Extension, ExtensionProperty} from '@gltf-transform/core';

import type {EncodeOptions, Encoder} from './encoder.js';
import type {ArrayRequest} from './index.js';

/** A decoder that works where it is called. */
export interface SyncDecoder {
  decode(payload: Uint8Array, requests: readonly ArrayRequest[]): Uint8Array[];
}

/** What `io.registerDependencies()` takes. */
export function loadDependencies(): Promise<{'tutte.decoder': SyncDecoder; 'tutte.encoder': Encoder}>;

/** TUTTE_mesh_compression. While it is in use, documents are written compressed. */
export class TutteMeshCompression extends Extension {
  static readonly EXTENSION_NAME: 'TUTTE_mesh_compression';
  setEncoderOptions(options: EncodeOptions): this;
  read(context: any): this;
  write(context: any): this;
}

/** A primitive's mark that its triangles are fans of polygons: consecutive triangles with the same first vertex. */
export class NgonMark extends ExtensionProperty {
  init(): void;
}

/** FB_ngon_encoding: without it, glTF-Transform drops the marks. */
export class FBNgonEncoding extends Extension {
  static readonly EXTENSION_NAME: 'FB_ngon_encoding';
  createNgonMark(): NgonMark;
  read(context: any): this;
  write(context: any): this;
}

/** A primitive's polygons. */
export class MeshPolygon extends ExtensionProperty {
  init(): void;
  getCount(): number;
  setCount(count: number): this;
  getArray(name: 'indicesOffsets' | 'loopIndices' | 'loopIndicesOffsets'): Accessor | null;
  setArray(name: 'indicesOffsets' | 'loopIndices' | 'loopIndicesOffsets', accessor: Accessor | null): this;
}

/** EXT_mesh_polygon: without it, glTF-Transform drops the polygons. */
export class EXTMeshPolygon extends Extension {
  static readonly EXTENSION_NAME: 'EXT_mesh_polygon';
  createMeshPolygon(): MeshPolygon;
  read(context: any): this;
  write(context: any): this;
}

/** All three, for `io.registerExtensions()`. */
export const TutteExtensions: (typeof Extension)[];

/** Has the document written compressed: `await document.transform(tutte({positionBits: 12}))`. */
export function tutte(options?: EncodeOptions): (document: Document) => void;
