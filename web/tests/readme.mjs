// Every example of the package's README, as written, from the packed tarball.
//
//   node readme.mjs TUTTE BUILD_FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, before} from 'node:test';

import {needBrowser, startBrowser} from './browser.mjs';
import {readGlb, writeGlb} from './glb.mjs';
import {models} from './models.mjs';
import {EXTENSION_NAME} from './names.mjs';
import {installed, need, npm, scratch} from './places.mjs';

need(join(npm, 'three'), join(npm, 'babylonjs'), join(npm, 'playcanvas'), join(npm, '@gltf-transform/core'));
needBrowser();

// A project as that of a user who has installed the package, and the others that the examples name.
const modules = join(scratch, 'node_modules');
mkdirSync(modules);
cpSync(installed, join(modules, 'tutte-gltf'), {recursive: true});
for (const name of ['three', 'babylonjs', 'babylonjs-loaders', 'playcanvas']) symlinkSync(join(npm, name), join(modules, name));
mkdirSync(join(modules, '@gltf-transform'));
for (const name of ['core', 'extensions']) cpSync(join(npm, '@gltf-transform', name), join(modules, '@gltf-transform', name), {recursive: true});
for (const name of ['property-graph', 'ktx-parse']) symlinkSync(join(npm, name), join(modules, name));
cpSync(shaded(models()[2]), join(scratch, 'model.glb'));

/** The model with a material that needs no reflections to be seen. */
function shaded(model) {
  const {json, bin} = readGlb(model.compressedBytes()), file = join(scratch, 'shaded.glb');
  json.materials = [{pbrMetallicRoughness: {metallicFactor: 0, baseColorFactor: [0.9, 0.8, 0.6, 1]}}];
  for (const mesh of json.meshes) for (const primitive of mesh.primitives) primitive.material = 0;
  writeFileSync(file, writeGlb(json, bin));
  return file;
}

const text = readFileSync(join(installed, 'README.md'), 'utf8');
const examples = [...text.matchAll(/^`([\w.]+)`\n\n```\w+\n(.*?)^```/gms)].map(([, name, code]) => ({name, code}));
for (const {name, code} of examples) writeFileSync(join(scratch, name), code);

/** @type {any} */
let started;
before(async () => { started = await startBrowser({project: scratch}); });
after(() => started.close());

test('there are examples', () => assert.deepEqual(examples.map(({name}) => name), ['three.html', 'babylon.html',
  'playcanvas.html', 'transform.mjs', 'tutte.config.mjs', 'encode.mjs', 'decode.mjs']));

for (const {name} of examples.filter((example) => example.name.endsWith('.html'))) {
  test(name, async () => {
    const page = await started.browser.newPage({viewport: {width: 640, height: 480}});
    const problems = [];
    page.on('pageerror', (error) => problems.push(String(error)));
    await page.goto(`${started.server.url}/project/${name}`);
    // Something is drawn when the middle of the picture is not its corner.
    const shown = async () => {
      const picture = await page.screenshot({path: join(scratch, `${name}.png`)});
      return page.evaluate(async (bytes) => {
        const image = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
        const context = new OffscreenCanvas(640, 480).getContext('2d');
        context.drawImage(image, 0, 0);
        const colours = new Set();
        for (let i = 0; i < 400; ++i) colours.add(context.getImageData(20 + 30 * (i % 20), 20 + 22 * Math.floor(i / 20), 1, 1).data.join());
        return colours.size;
      }, Array.from(picture));
    };
    let colours = 0;
    for (let i = 0; i < 40 && colours < 8 && problems.length === 0; ++i) {
      await page.waitForTimeout(250);
      await page.waitForFunction(() => !document.getElementById('babylonjsLoadingDiv'));
      colours = await shown();
    }
    assert.deepEqual(problems, []);
    assert.ok(colours >= 8, `only ${colours} colours`);
    await page.close();
  });
}

const run = (name) => execFileSync(process.execPath, [name], {cwd: scratch, encoding: 'utf8'});
const used = (name) => readGlb(new Uint8Array(readFileSync(join(scratch, name)))).json.extensionsUsed ?? [];

test('transform.mjs', () => {
  run('transform.mjs');
  assert.ok(used('smaller.glb').includes(EXTENSION_NAME));
});

test('encode.mjs', () => {
  assert.match(run('encode.mjs'), /^\d+ \d+ \[\]/);
  assert.ok(!used('plain.glb').includes(EXTENSION_NAME));
  assert.ok(used('compressed.glb').includes('EXT_mesh_polygon'));
});

test('decode.mjs', () => assert.match(run('decode.mjs'), /^\[[ \d\n,]+\]\n$/));

const command = join(npm, '@gltf-transform/cli/bin/cli.js');
test('the command with tutte.config.mjs', {skip: !existsSync(command) && 'gltf-transform is not installed'}, () => {
  rmSync(join(scratch, 'copy.glb'), {force: true});
  const line = text.match(/^gltf-transform (.*)$/m)[1].split(' ');
  execFileSync(process.execPath, [command, ...line], {cwd: scratch, stdio: ['ignore', 'ignore', 'pipe']});
  assert.ok(used('copy.glb').includes(EXTENSION_NAME));
});
