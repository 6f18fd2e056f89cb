import {Instance} from './instance.js';

/** One thread's instances: of the module without Draco, and of that with it once a payload has needed it. */
export class Host {
  /** @param {(draco: boolean) => Promise<WebAssembly.Module>} moduleOf */
  constructor(moduleOf) {
    this.moduleOf = moduleOf;
    /** @type {Map<boolean, Promise<Instance>>} */
    this.instances = new Map();
  }

  /** @param {boolean} draco @returns {Promise<Instance>} */
  #instance(draco) {
    let instance = this.instances.get(draco);
    if (!instance) {
      instance = this.moduleOf(draco).then((module) => new Instance(module, draco));
      this.instances.set(draco, instance);
    }
    return instance;
  }

  /**
   * Calls a method of an Instance.
   * @param {'decode' | 'describe'} method
   * @param {unknown[]} args
   */
  async call(method, args) {
    const call = (/** @type {any} */ instance) => instance[method](...args);
    try {
      return call(await this.#instance(false));
    } catch (error) {
      if (/** @type {any} */ (error)?.code !== 'NOT_BUILT') throw error;
    }
    return call(await this.#instance(true));
  }
}
