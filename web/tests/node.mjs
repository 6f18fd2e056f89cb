// The package in Node.js, as installed from its tarball into an empty project.
//
//   node node.mjs TUTTE BUILD_FOLDER
import assert from 'node:assert/strict';
import {pathToFileURL} from 'node:url';
import {join} from 'node:path';
import test from 'node:test';

import {readGlb} from './glb.mjs';
import {models} from './models.mjs';
import {installed, need} from './places.mjs';

need();
const {loadTutte, TutteError, EXTENSION_NAME} = await import(pathToFileURL(join(installed, 'src/index.js')).href);
const {CompressedViews, compressedView} = await import(pathToFileURL(join(installed, 'src/gltf.js')).href);

const all = models();
const tutte = await loadTutte();

/** @param {any} decoder @param {Uint8Array} bytes */
function viewsOf(decoder, bytes) {
  const {json, bin} = readGlb(bytes);
  return {json, views: new CompressedViews(json, decoder, async () => bin)};
}

/** The decoded bytes of every compressed view. */
async function decodeAll(decoder, bytes) {
  const {json, views} = viewsOf(decoder, bytes);
  return Promise.all(json.bufferViews.map((_, index) => views.load(index)));
}

async function compare(decoder, model) {
  const {json, bin} = readGlb(model.plainBytes());
  const decoded = await decodeAll(decoder, model.compressedBytes());
  let compared = 0;
  decoded.forEach((bytes, index) => {
    if (bytes === null) return;
    const {byteOffset = 0, byteLength} = json.bufferViews[index];
    assert.deepEqual(Buffer.from(bytes), Buffer.from(bin.subarray(byteOffset, byteOffset + byteLength)), `view ${index}`);
    ++compared;
  });
  assert.ok(compared > 1, 'nothing was compressed');
}

for (const model of all) {
  test(`${model.name}: the native decoder's bytes`, () => compare(tutte, model));
}

test('a pool of workers gives the same', async () => {
  const pool = await loadTutte({workers: 2});
  await Promise.all(all.map((model) => compare(pool, model)));
  pool.dispose();
  await compare(pool, all[0]);
});

test('modules by URL, as bytes and compiled', async () => {
  const {readFileSync} = await import('node:fs');
  const bytes = readFileSync(join(installed, 'wasm/decoder.wasm'));
  const draco = readFileSync(join(installed, 'wasm/decoder-draco.wasm'));
  await compare(await loadTutte({wasm: bytes, dracoWasm: draco}), all[1]);
  await compare(await loadTutte({wasm: await WebAssembly.compile(bytes)}), all[0]);
  const url = `data:application/wasm;base64,${bytes.toString('base64')}`;
  await compare(await loadTutte({wasm: url}), all[0]);
  await assert.rejects(loadTutte({wasm: new Uint8Array([1, 2, 3])}), WebAssembly.CompileError);
});

function firstPayload(model) {
  const {json, bin} = readGlb(model.compressedBytes());
  const view = json.bufferViews.map((_, i) => compressedView(json, i)).find((found) => found);
  const requests = json.bufferViews.map((_, i) => compressedView(json, i))
    .filter((other) => other && other.byteOffset === view.byteOffset);
  return {payload: bin.slice(view.byteOffset, view.byteOffset + view.byteLength), requests};
}

test('a description without decoding', async () => {
  const {payload} = firstPayload(all[0]);
  const {vertices, wedges, faces, triangles, attributes, sections} = await tutte.describe(payload);
  assert.deepEqual({vertices, faces, triangles, attributes}, {vertices: 1152, faces: 1152, triangles: 2304, attributes: 3});
  assert.equal(wedges, 49 * 25);
  assert.deepEqual(sections.map((section) => section.name), ['CONNECTIVITY', 'SEAMS', 'ATTRIBUTES']);
  assert.equal(sections.at(-1).byteOffset + sections.at(-1).byteLength, payload.length);
});

for (const model of all.slice(0, 2)) {
  test(`${model.name}: damage is an error, and the decoder goes on`, async () => {
    const {payload, requests} = firstPayload(model);
    for (let size = 0; size < payload.length; size += 1 + Math.floor(payload.length / 100)) {
      await assert.rejects(tutte.decode(payload.subarray(0, size), requests), TutteError);
    }
    for (let i = 0; i < 200; ++i) {
      const damaged = payload.slice();
      damaged[Math.floor(i * payload.length / 200)] ^= 1 << i % 8;
      await assert.rejects(tutte.decode(damaged, requests), TutteError);
    }
    await compare(tutte, model);
  });
}

test('a mesh that no memory holds is an error, and the decoder goes on', async () => {
  const {payload, requests} = firstPayload(all[0]);
  const varint = [0xFF, 0xFF, 0xFF, 0xFF, 0x07];
  const huge = new Uint8Array([0x54, 0x55, 0x54, 0x54, 0, 1, ...varint, ...varint, ...varint, 1, 0, 0, 0, 0, 0]);
  await assert.rejects(tutte.decode(huge, []), TutteError);
  await assert.rejects(tutte.decode(new Uint8Array(huge.buffer.slice(0, 21)), requests), TutteError);
  await compare(tutte, all[0]);
});

test('what a trap leaves behind is thrown away', async () => {
  const {Instance} = await import(pathToFileURL(join(installed, 'src/instance.js')).href);
  const {readFileSync} = await import('node:fs');
  const module = await WebAssembly.compile(readFileSync(join(installed, 'wasm/decoder-draco.wasm')));
  const instance = new Instance(module, true);
  const {payload, requests} = firstPayload(all[0]);
  instance.decode(payload, requests);
  instance.exports = {...instance.exports, tutte_decode_payload: () => { throw new WebAssembly.RuntimeError('unreachable'); }};
  assert.throws(() => instance.decode(payload, requests), {code: 'STOPPED'});
  assert.equal(instance.exports, null);
  assert.equal(instance.decode(payload, requests).length, requests.length);
});

test('JSON that breaks the rules', () => {
  const {json} = readGlb(all[0].compressedBytes());
  const index = json.bufferViews.findIndex((view) => view.extensions?.[EXTENSION_NAME]);
  const broken = (change) => {
    const copy = structuredClone(json);
    change(copy.bufferViews[index].extensions[EXTENSION_NAME], copy.bufferViews[index]);
    return () => compressedView(copy, index);
  };
  assert.throws(broken((object) => { object.mode = 'SOMETHING'; }), {code: 'UNKNOWN_MODE'});
  assert.throws(broken((object) => { object.mode = 'WELD', object.attribute = 1; }), {code: 'INVALID_JSON'});
  for (const name of ['buffer', 'byteLength', 'byteStride', 'count']) {
    for (const value of [undefined, -1, 1.5, '1', null, 1e300]) {
      assert.throws(broken((object) => { object[name] = value; }), {code: 'INVALID_JSON'}, `${name} ${value}`);
    }
  }
  assert.throws(broken((_, view) => { view.byteLength -= 1; }), {code: 'INVALID_JSON'});
  assert.throws(broken((_, view) => { view.extensions[EXTENSION_NAME] = null; }), {code: 'INVALID_JSON'});
});

test('a payload outside its buffer, and a wrong count', async () => {
  const {json, bin} = readGlb(all[0].compressedBytes());
  const index = json.bufferViews.findIndex((view) => view.extensions?.[EXTENSION_NAME]);
  await assert.rejects(new CompressedViews(json, tutte, async () => bin.slice(0, 40)).load(index), {code: 'INVALID_JSON'});
  const view = json.bufferViews[index], object = view.extensions[EXTENSION_NAME];
  object.count += 3;
  view.byteLength = object.count * object.byteStride;
  await assert.rejects(new CompressedViews(json, tutte, async () => bin).load(index), {code: 'COUNT_MISMATCH'});
});

test('two hundred meshes do not grow memory', async () => {
  const {Instance} = await import(pathToFileURL(join(installed, 'src/instance.js')).href);
  const {readFileSync} = await import('node:fs');
  const instance = new Instance(await WebAssembly.compile(readFileSync(join(installed, 'wasm/decoder-draco.wasm'))), true);
  const payloads = all.slice(0, 4).map(firstPayload);
  const round = () => payloads.forEach(({payload, requests}) => instance.decode(payload, requests));
  round();
  const size = instance.exports.memory.buffer.byteLength;
  for (let i = 0; i < 50; ++i) round();
  assert.equal(instance.exports.memory.buffer.byteLength, size);
});
