// A decoding thread: in browsers a module worker, in Node.js a worker thread.
import {Host} from './host.js';

/** @type {Map<boolean, {promise: Promise<WebAssembly.Module>, resolve: (module: WebAssembly.Module) => void}>} */
const modules = new Map();

/** @param {boolean} draco */
function module(draco) {
  let entry = modules.get(draco);
  if (!entry) {
    let resolve = (/** @type {WebAssembly.Module} */ _) => {};
    const promise = new Promise((/** @type {(module: WebAssembly.Module) => void} */ done) => { resolve = done; });
    entry = {promise, resolve};
    modules.set(draco, entry);
  }
  return entry;
}

/** @param {(message: any, transfer: ArrayBuffer[]) => void} post */
function serve(post) {
  const host = new Host((draco) => {
    if (!modules.has(draco)) post({wanted: draco}, []);
    return module(draco).promise;
  });
  return async (/** @type {any} */ message) => {
    if (message.module) return module(message.draco).resolve(message.module);
    const {id, method, args} = message;
    try {
      const result = await host.call(method, args);
      const transfer = method === 'decode' ? result.map((/** @type {Uint8Array} */ bytes) => bytes.buffer) : [];
      post({id, result}, transfer);
    } catch (error) {
      const {code = 'UNKNOWN', message: sentence} = /** @type {any} */ (error);
      post({id, error: {code, message: sentence}}, []);
    }
  };
}

if (typeof globalThis.postMessage === 'function') {
  const scope = /** @type {any} */ (globalThis);
  const receive = serve((message, transfer) => scope.postMessage(message, transfer));
  scope.onmessage = (/** @type {MessageEvent} */ event) => receive(event.data);
} else {
  const {parentPort} = await import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:worker_threads');
  parentPort?.on('message', serve((message, transfer) => parentPort.postMessage(message, transfer)));
}
