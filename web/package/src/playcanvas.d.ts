import type {Tutte} from './index.js';

type Done<T> = (error: unknown, result: T | null) => void;

/**
 * Options of a PlayCanvas container asset that make it decode TUTTE_mesh_compression:
 * `new pc.Asset(name, 'container', {url}, null, tutteContainerOptions(tutte))`.
 */
export function tutteContainerOptions(tutte: Tutte | Promise<Tutte>): {
  buffer: {processAsync(buffer: any, done: Done<Uint8Array>): void};
  bufferView: {processAsync(view: any, buffers: Promise<Uint8Array>[], done: Done<Uint8Array>): void};
};
