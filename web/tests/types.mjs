// The package's types: that its sources agree with them, and that a program in TypeScript can use them.
//
//   node types.mjs TUTTE BUILD_FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {cpSync, symlinkSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

import {installed, need, npm, scratch, tests} from './places.mjs';

need(join(npm, 'typescript'));
cpSync(installed, scratch, {recursive: true});
cpSync(join(tests, 'tsconfig.json'), join(scratch, 'tsconfig.json'));
symlinkSync(npm, join(scratch, 'node_modules'));
for (const name of ['decoder', 'decoder-draco', 'encoder']) writeFileSync(join(scratch, `wasm/${name}.js`), "export default '';\n");
writeFileSync(join(scratch, 'user.ts'), `
import {NodeIO} from '@gltf-transform/core';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {loadTutte, TutteError, type Mode} from 'tutte-gltf';
import {loadEncoder} from 'tutte-gltf/encoder';
import {loadDependencies, tutte, TutteExtensions} from 'tutte-gltf/gltf-transform';
import {CompressedViews} from 'tutte-gltf/gltf';
import {tutteContainerOptions} from 'tutte-gltf/playcanvas';
import {polygonLines, TutteMeshCompression} from 'tutte-gltf/three';

const decoder = loadTutte({workers: 1});
const loader = new GLTFLoader().register((parser) => new TutteMeshCompression(parser, decoder));
loader.loadAsync('model.glb').then((gltf) => polygonLines(gltf, gltf.scene.children[0] as any));
const io = new NodeIO().registerExtensions(TutteExtensions).registerDependencies(await loadDependencies());
await (await io.read('model.glb')).transform(tutte({positionBits: 12, polygons: 'both'}));
const {glb, warnings} = (await loadEncoder()).compress(new Uint8Array(), {effort: 1, errors: {position: '0.1%', color: 0.01}});
const mode: Mode = 'DEGREES';
tutteContainerOptions(decoder).bufferView.processAsync({}, [], () => {});
export const all = [glb.length + warnings.length, mode, new TutteError('A', 'b').code, CompressedViews];
// @ts-expect-error there is no such option
tutte({bits: 3});
// @ts-expect-error there is no such bound
tutte({errors: {position: '3 mm'}});
`);

test('sources, declarations and a user agree', () => {
  try {
    execFileSync(process.execPath, [join(npm, 'typescript/lib/tsc.js'), '-p', scratch], {encoding: 'utf8'});
  } catch (error) {
    assert.fail(error.stdout);
  }
});
