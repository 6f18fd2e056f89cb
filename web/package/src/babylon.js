import {CompressedViews} from './gltf.js';
import {EXTENSION_NAME} from './index.js';

/** An extension of Babylon.js's glTF loader. */
class TutteMeshCompression {
  name = EXTENSION_NAME;
  /** @type {CompressedViews | undefined} */
  views;

  /** @param {any} loader @param {import('./index.js').Tutte | Promise<import('./index.js').Tutte>} tutte */
  constructor(loader, tutte) {
    this.enabled = loader.isExtensionUsed(EXTENSION_NAME);
    this.loader = loader;
    this.tutte = tutte;
  }

  dispose() {
    this.loader = null;
    this.views = undefined;
  }

  /** @param {string} _context @param {{index: number}} bufferView @returns {Promise<ArrayBufferView> | null} */
  loadBufferViewAsync(_context, bufferView) {
    const {loader} = this;
    this.views ??= new CompressedViews(loader.gltf, this.tutte, (index) => {
      const buffer = loader.gltf.buffers[index];
      return loader.loadBufferAsync(`/buffers/${index}`, buffer, 0, buffer.byteLength);
    });
    return this.views.load(bufferView.index);
  }
}

/** @type {import('./babylon.js').registerTutte} */
export function registerTutte(registerGLTFExtension, tutte) {
  registerGLTFExtension(EXTENSION_NAME, true, (/** @type {any} */ loader) => new TutteMeshCompression(loader, tutte));
}
