// The encoder, and glTF-Transform with it, in Node.js: from the packed tarball.
//
//   node transform.mjs TUTTE BUILD_FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, rmSync, symlinkSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import test from 'node:test';

import {readGlb, writeGlb} from './glb.mjs';
import {models} from './models.mjs';
import {EXTENSION_NAME} from './names.mjs';
import {installed, need, npm, project, scratch, tutte as native} from './places.mjs';

need(join(npm, '@gltf-transform/core'));
// The project has glTF-Transform too, as that of a user who has installed it.
const link = join(project, 'node_modules/@gltf-transform');
rmSync(link, {recursive: true, force: true});
symlinkSync(join(npm, '@gltf-transform'), link);
const load = (name) => import(pathToFileURL(join(installed, `src/${name}.js`)).href);
const {loadEncoder} = await load('encoder');
const {TutteError} = await load('index');
const {loadDependencies, tutte, TutteExtensions, TutteMeshCompression, MeshPolygon, NgonMark} = await load('gltf-transform');
const {NodeIO} = await import(pathToFileURL(join(npm, '@gltf-transform/core/dist/index.js')).href);

const all = models();
const encoder = await loadEncoder();
const io = new NodeIO().registerExtensions(TutteExtensions).registerDependencies(await loadDependencies());

function run(...args) {
  execFileSync(native, args, {stdio: ['ignore', 'ignore', 'pipe']});
}

for (const model of all) {
  test(`${model.name}: the encoder's file is the native one's`, () => {
    const file = join(scratch, 'native.glb');
    run('encode', model.plain, file, '--qp', '12');
    const {glb} = encoder.compress(model.plainBytes(), {positionBits: 12});
    assert.ok(Buffer.from(glb).equals(readFileSync(file)), `${glb.length} bytes`);
    run('decode', file, join(scratch, 'native.plain.glb'));
    assert.ok(Buffer.from(encoder.decompress(glb)).equals(readFileSync(join(scratch, 'native.plain.glb'))));
  });
}

const precisions = [
  [{errors: {position: 0.003}}, '--error', '0.003'],
  [{errors: {position: '0.1%', texcoord: 0.002}}, '--error', '0.1%,TEXCOORD=0.002'],
  [{grid: 'mesh', positionBits: 12}, '--grid', 'mesh', '--qp', '12'],
  [{lossless: true}, '--lossless'],
];
for (const [options, ...words] of precisions) {
  test(`${words.join(' ')}: the encoder's file is the native one's`, () => {
    for (const model of all.slice(0, 3)) {
      const file = join(scratch, 'native.glb');
      run('encode', model.plain, file, ...words);
      const {glb} = encoder.compress(model.plainBytes(), options);
      assert.ok(Buffer.from(glb).equals(readFileSync(file)), `${model.name}: ${glb.length} bytes`);
    }
  });
}

test('options that cannot be are errors', () => {
  const good = all[0].plainBytes();
  const wrong = [0, -1, NaN, Infinity, '1', 'x%', '%', '-1%', '100%', null, {}].map((position) => ({errors: {position}}));
  wrong.push({errors: {normal: 1}}, {errors: null}, {errors: 3}, {grid: 'all'}, {lossless: 2}, {lossless: true, positionBits: 3},
    {lossless: true, errors: {position: 1}});
  for (const options of wrong) {
    assert.throws(() => encoder.compress(good, options), {code: 'INVALID_ARGUMENT'}, JSON.stringify(options));
  }
});

test('the encoder refuses what is no GLB, and goes on', () => {
  for (const bytes of [new Uint8Array(), new Uint8Array(100), new TextEncoder().encode('{"asset": {"version": "1.0"}}')]) {
    assert.throws(() => encoder.compress(bytes), TutteError);
  }
  const good = all[0].plainBytes();
  for (let size = 0; size < good.length; size += 1 + (good.length >> 5)) {
    assert.throws(() => encoder.compress(good.subarray(0, size)), TutteError);
  }
  assert.throws(() => encoder.compress(good, {positionBits: 99}), {code: 'INVALID_ARGUMENT'});
  assert.throws(() => encoder.compress(good, {effort: 7}), {code: 'INVALID_ARGUMENT'});
  assert.throws(() => encoder.compress(good, {polygons: 'some'}), {code: 'INVALID_ARGUMENT'});
  assert.throws(() => encoder.compress(good, {bits: 3}), {code: 'INVALID_ARGUMENT'});
  assert.ok(encoder.compress(good).glb.length < good.length);
});

/** Everything that matters of a document's primitives. */
function contentOf(document) {
  return document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives().map((primitive) => ({
    indices: Array.from(primitive.getIndices().getArray()),
    attributes: Object.fromEntries(primitive.listSemantics().sort()
      .map((name) => [name, Array.from(primitive.getAttribute(name).getArray())])),
    targets: primitive.listTargets().map((target) => Object.fromEntries(
      target.listSemantics().sort().map((name) => [name, Array.from(target.getAttribute(name).getArray())]))),
    ngons: primitive.getExtension('FB_ngon_encoding') !== null,
    polygons: polygonsOf(primitive.getExtension('EXT_mesh_polygon')),
  })));
}

function polygonsOf(property) {
  return property && ['indicesOffsets', 'loopIndices', 'loopIndicesOffsets']
    .map((name) => Array.from(property.getArray(name).getArray()));
}

for (const model of all) {
  test(`${model.name}: glTF-Transform reads what the plain file says`, async () => {
    const compressed = await io.read(model.compressed), plain = await io.read(model.plain);
    assert.deepEqual(contentOf(compressed), contentOf(plain));
    assert.equal(compressed.getRoot().listBuffers().length, 1);
  });
}

test('glTF-Transform writes compressed files that the native command verifies', async () => {
  for (const model of all) {
    for (const suffix of ['glb', 'gltf']) {
      const document = await io.read(model.plain), file = join(scratch, `written.${suffix}`);
      await document.transform(tutte({positionBits: 14, normalBits: 10, texcoordBits: 12}));
      await io.write(file, document);
      run('verify', model.plain, file, '--qp', '14', '--qn', '10', '--qt', '12');
      run('validate', file);
      const size = suffix === 'glb' ? readFileSync(file).length : 0;
      assert.ok(size < model.plainBytes().length);
    }
  }
});

test('a compressed document can be written plain again', async () => {
  const document = await io.read(all[0].compressed);
  document.getRoot().listExtensionsUsed().find((used) => used.extensionName === EXTENSION_NAME).dispose();
  const bytes = await io.writeBinary(document);
  assert.ok(!(readGlb(bytes).json.extensionsUsed ?? []).includes(EXTENSION_NAME));
  assert.deepEqual(contentOf(await io.readBinary(bytes)), contentOf(document));
});

test('a fallback is kept on request, and the extension is not required then', async () => {
  const document = await io.read(all[0].plain);
  await document.transform(tutte({fallback: true}));
  const {json} = readGlb(await io.writeBinary(document));
  assert.ok(json.extensionsUsed.includes(EXTENSION_NAME));
  assert.ok(!(json.extensionsRequired ?? []).includes(EXTENSION_NAME));
});

test('polygons survive, both kinds', async () => {
  const both = await io.read(all[2].compressed);
  const [{ngons, polygons}] = contentOf(both);
  assert.equal(ngons, true);
  assert.equal(polygons[0].length, 48 * 24);
  const again = await io.readBinary(await io.writeBinary(both));
  assert.equal(contentOf(again)[0].polygons[0].length, 48 * 24);
  const primitive = both.getRoot().listMeshes()[0].listPrimitives()[0];
  assert.ok(primitive.getExtension('FB_ngon_encoding') instanceof NgonMark);
  assert.ok(primitive.getExtension('EXT_mesh_polygon') instanceof MeshPolygon);
});

test('damaged files are errors', async () => {
  const {json, bin} = readGlb(all[0].compressedBytes());
  const object = json.bufferViews.find((view) => view.extensions?.[EXTENSION_NAME]).extensions[EXTENSION_NAME];
  const copy = bin.slice();
  copy[(object.byteOffset ?? 0) + object.byteLength - 4] ^= 1;
  await assert.rejects(io.readBinary(writeGlb(json, copy)), TutteError);
  object.byteLength = 1e9;
  await assert.rejects(io.readBinary(writeGlb(json, bin)), TutteError);
  object.mode = 'SOMETHING';
  await assert.rejects(io.readBinary(writeGlb(json, bin)), {code: 'UNKNOWN_MODE'});
});

test('without the dependency it says so', async () => {
  const bare = new NodeIO().registerExtensions([TutteMeshCompression]);
  await assert.rejects(bare.read(all[0].compressed), /tutte\.decoder/);
});
