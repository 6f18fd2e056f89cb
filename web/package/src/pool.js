import {TutteError} from './error.js';

/**
 * A worker of either kind, behind one face.
 * @typedef {object} Thread
 * @property {(message: any) => void} post
 * @property {(busy: boolean) => void} keepAlive  whether Node.js must wait for it
 * @property {() => void} stop
 */

/** @param {(message: any) => void} onMessage @param {(error: unknown) => void} onError @returns {Promise<Thread>} */
async function startThread(onMessage, onError) {
  if (typeof Worker === 'function') {
    const worker = new Worker(new URL('./worker.js', import.meta.url), {type: 'module'});
    worker.onmessage = (event) => onMessage(event.data);
    worker.onerror = onError;
    return {post: (message) => worker.postMessage(message), keepAlive: () => {}, stop: () => worker.terminate()};
  }
  const threads = await import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:worker_threads');
  const worker = new threads.Worker(new URL('./worker.js', import.meta.url));
  worker.on('message', onMessage);
  worker.on('error', onError);
  return {
    post: (message) => worker.postMessage(message),
    keepAlive: (busy) => void (busy ? worker.ref() : worker.unref()),
    stop: () => void worker.terminate(),
  };
}

/** Decoding threads. Each has one payload at a time; the others wait in a queue. */
export class Pool {
  /**
   * @param {number} size  threads at most; each starts when there is work for it
   * @param {(draco: boolean) => Promise<WebAssembly.Module>} moduleOf
   */
  constructor(size, moduleOf) {
    this.size = size;
    this.moduleOf = moduleOf;
    /** @type {any[]} */
    this.queue = [];
    /** @type {Set<PoolThread>} */
    this.threads = new Set();
    this.nextId = 0;
  }

  /**
   * Calls a method of an Instance on one of the threads. Rejects with code 'NO_WORKERS' where threads cannot be had.
   * @param {'decode' | 'describe'} method
   * @param {unknown[]} args
   */
  call(method, args) {
    return new Promise((resolve, reject) => {
      this.queue.push({id: this.nextId++, method, args, resolve, reject});
      const idle = [...this.threads].find((thread) => !thread.task);
      if (idle) idle.next();
      else if (this.threads.size < this.size) this.threads.add(new PoolThread(this));
    });
  }

  /** Stops all threads; what they were doing is rejected. */
  dispose() {
    this.fail(new TutteError('DISPOSED', 'the decoder was disposed of'));
  }

  /** @param {TutteError} error */
  fail(error) {
    this.size = 0;
    const tasks = this.queue.splice(0);
    for (const thread of this.threads) {
      if (thread.task) tasks.push(thread.task);
      thread.stop();
    }
    this.threads.clear();
    for (const task of tasks) task.reject(error);
  }
}

class PoolThread {
  /** @param {Pool} pool */
  constructor(pool) {
    this.pool = pool;
    /** @type {any} */
    this.task = pool.queue.shift();
    this.stopped = false;
    const started = startThread((message) => this.#receive(message), () => this.#broken());
    started.then((thread) => {
      if (this.stopped) return thread.stop();
      this.thread = thread;
      this.#post();
    }, () => this.#broken());
  }

  /** Takes the next task, if there is one. */
  next() {
    this.task = this.pool.queue.shift();
    this.thread?.keepAlive(this.task !== undefined);
    if (this.task) this.#post();
  }

  #post() {
    const {id, method, args} = this.task;
    this.thread?.post({id, method, args});
  }

  /** @param {any} message */
  async #receive(message) {
    if ('wanted' in message) {
      const module = await this.pool.moduleOf(message.wanted);
      return this.thread?.post({module, draco: message.wanted});
    }
    const task = this.task;
    if (!task || message.id !== task.id) return;
    this.next();
    if (message.error) task.reject(TutteError.from(message.error));
    else task.resolve(message.result);
  }

  #broken() {
    if (!this.stopped) this.pool.fail(new TutteError('NO_WORKERS', 'no worker could be started'));
  }

  stop() {
    this.stopped = true;
    this.thread?.stop();
  }
}
