// What is true of every loader with the plug-in.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';

import {coloursOf, difference, drawn} from './browser.mjs';
import {readGlb, writeGlb} from './glb.mjs';
import {EXTENSION_NAME} from './names.mjs';
import {Model} from './models.mjs';

/**
 * @param {object} loader
 * @param {(url: string, decoder: 'pool' | 'local' | null) => Promise<any>} loader.show  a picture, or an error
 * @param {(url: string, times: number) => Promise<number>} loader.loadMany  bytes in use after as many loads
 * @param {Model[]} loader.models
 * @param {() => any} loader.started
 * @param {() => any} loader.opened
 * @param {boolean} [loader.fetchesFallback]  the loader cannot be kept from it
 */
export function loaderTests({show, loadMany, models, started, opened, fetchesFallback = false}) {
  for (const model of models) {
    test(`${model.name}: the picture of the plain file`, async () => {
      model.compressed, model.plain;
      const plain = await show(`/models/${model.name}.plain.glb`, null);
      const compressed = await show(`/models/${model.name}.glb`, 'pool');
      assert.equal(plain.error, undefined);
      assert.equal(compressed.error, undefined);
      assert.ok(drawn(plain.picture) > 1000, 'the plain file draws nothing');
      assert.ok(coloursOf(plain.picture) > 3, 'the plain file has no shades');
      assert.equal(difference(plain.picture, compressed.picture), 0);
    });
  }

  test('without workers it is the same', async () => {
    const [model] = models;
    const {picture} = await show(`/models/${model.name}.glb`, 'local');
    assert.equal(difference(picture, (await show(`/models/${model.name}.plain.glb`, null)).picture), 0);
  });

  test('without the plug-in a required file gives the loader\'s error', async () => {
    const {error} = await show(`/models/${models[0].name}.glb`, null);
    assert.match(error, /\S/);
  });

  test('fallback data is for those without the plug-in', async () => {
    const model = new Model(models[0].source, ['--fallback']);
    const {files, requests} = started().server;
    // The fallback as a file of its own, so that it can be seen whether it is fetched.
    const {json, bin} = readGlb(model.compressedBytes());
    const buffer = json.buffers.find((/** @type {any} */ one) => one.extensions?.[EXTENSION_NAME]?.fallback);
    if (buffer.uri.startsWith('data:')) {
      files.set('/models/fallback.bin', Buffer.from(buffer.uri.split(',')[1], 'base64'));
    } else {
      files.set('/models/fallback.bin', readFileSync(new URL(buffer.uri, `file://${model.compressed}`)));
    }
    buffer.uri = 'fallback.bin';
    files.set('/models/with-fallback.glb', writeGlb(json, bin));
    const from = requests.length;
    const {picture, error} = await show('/models/with-fallback.glb', 'pool');
    assert.equal(error, undefined);
    if (!fetchesFallback) assert.ok(!requests.slice(from).includes('/models/fallback.bin'), 'the fallback was fetched');
    const without = await show('/models/with-fallback.glb', null);
    assert.equal(without.error, undefined);
    assert.ok(requests.slice(from).includes('/models/fallback.bin'));
    assert.equal(difference(picture, without.picture), 0);
  });

  const damages = {
    corrupt: (/** @type {any} */ json, /** @type {Uint8Array} */ bin) => {
      const view = objectsOf(json)[0];
      bin[(view.byteOffset ?? 0) + view.byteLength - 5] ^= 4;
    },
    truncated: (/** @type {any} */ json) => objectsOf(json).forEach((view) => { view.byteLength -= 7; }),
    'outside its buffer': (/** @type {any} */ json) => objectsOf(json).forEach((view) => { view.byteOffset = 1e9; }),
    'of an unknown mode': (/** @type {any} */ json) => { objectsOf(json)[0].mode = 'SOMETHING'; },
  };
  for (const [what, damage] of Object.entries(damages)) {
    test(`a payload that is ${what} is an error, and the page goes on`, async () => {
      const {json, bin} = readGlb(models[0].compressedBytes());
      const copy = bin.slice();
      damage(json, copy);
      started().server.files.set('/models/damaged.glb', writeGlb(json, copy));
      const {error} = await show('/models/damaged.glb', 'pool');
      assert.match(error, /\S/);
      const {picture} = await show(`/models/${models[0].name}.glb`, 'pool');
      assert.ok(drawn(picture) > 1000);
    });
  }

  test('two hundred loads do not grow memory', async () => {
    const load = (/** @type {number} */ times) => loadMany(`/models/${models[0].name}.glb`, times);
    await load(20);
    const before = await load(50), after = await load(150);
    assert.ok(after < before + 2e6, `${before} bytes after 70 loads, ${after} after 220`);
  });

  test('nothing went wrong unseen', () => assert.deepEqual(opened().problems, []));
}

/** @param {any} json @returns {any[]} */
function objectsOf(json) {
  return json.bufferViews.map((/** @type {any} */ view) => view.extensions?.[EXTENSION_NAME])
    .filter((/** @type {any} */ object) => object);
}
