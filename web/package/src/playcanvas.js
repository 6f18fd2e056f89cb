import {CompressedViews} from './gltf.js';
import {EXTENSION_NAME} from './index.js';

/** @type {import('./playcanvas.js').tutteContainerOptions} */
export function tutteContainerOptions(tutte) {
  /** PlayCanvas hands out a file's views one by one, together with the list of its buffers. @type {WeakMap<object, any>} */
  const files = new WeakMap();

  /** @param {any} view @param {Promise<Uint8Array>[]} buffers */
  async function decoded(view, buffers) {
    let file = files.get(buffers);
    if (!file) {
      const json = {bufferViews: /** @type {any[]} */ ([])};
      file = {json, views: new CompressedViews(json, tutte, (index) => buffers[index])};
      files.set(buffers, file);
    }
    const index = file.json.bufferViews.push(view) - 1;
    await null;  // until all views of the file have come
    return file.views.load(index);
  }

  return {
    buffer: {
      // Nobody needs a fallback's bytes, so they are not fetched.
      processAsync(buffer, done) {
        done(null, buffer.extensions?.[EXTENSION_NAME]?.fallback ? new Uint8Array(0) : null);
      },
    },
    bufferView: {
      processAsync(view, buffers, done) {
        if (view.extensions?.[EXTENSION_NAME] === undefined) return done(null, null);
        decoded(view, buffers).then((bytes) => done(null, bytes), (error) => done(error, null));
      },
    },
  };
}
