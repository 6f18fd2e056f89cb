// Sizes and speeds of decoders in WebAssembly: ours, draco3d's and meshoptimizer's, on the same meshes in the same run, in
// Node.js and in Chromium. Fails when what ours decodes is not what the native decoder does.
//
//   node bench.mjs TUTTE BUILD_FOLDER [--seconds S] [--profile P] [FILE...]
import {existsSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';

import {openPage, startBrowser} from '../tests/browser.mjs';
import {assimpModels, corpus, installed, need, npm} from '../tests/places.mjs';

need(join(npm, 'draco3d'), join(npm, 'meshoptimizer'));
globalThis.crypto ??= (await import('node:crypto')).webcrypto;
const {inputsOf} = await import('./inputs.mjs');
const {measure} = await import('./measure.js');
const require = createRequire(join(npm, 'x.js'));
const {Instance} = await import(join(installed, 'src/instance.js'));
const {Modules} = await import(join(installed, 'src/modules.js'));
const {MeshoptDecoder} = await import(join(npm, 'meshoptimizer/meshopt_decoder.mjs'));

const files = process.argv.slice(4);
const option = (name) => {
  const at = files.indexOf(name);
  return at < 0 ? undefined : files.splice(at, 2)[1];
};
const seconds = Number(option('--seconds') ?? 0.5), profile = option('--profile');
if (files.length === 0) {
  files.push(...['Collada/duck.dae', 'OBJ/spider.obj'].map((name) => join(assimpModels, name)),
    ...['polygon/beast.obj', 'polygon/makehuman_base.obj', 'triangle/igea_134345.ply'].map((name) => join(corpus, name)));
}

await MeshoptDecoder.ready;
const decoders = {
  instance: new Instance(await new Modules({}).get(true), true),
  draco: await require('draco3d').createDecoderModule({}),
  meshopt: MeshoptDecoder,
};
const started = existsSync('/usr/bin/chromium') ? await startBrowser({bench: dirname(fileURLToPath(import.meta.url))}) : null;
const page = started && (await openPage(started, 'page.html', 'bench')).page;
const encode = (key, value) => (value instanceof Uint8Array ? {base64: Buffer.from(value).toString('base64')} : value);

console.log('Decoders, bytes (gzip):');
const size = (path) => {
  const bytes = readFileSync(path);
  return `${bytes.length} (${gzipSync(bytes, {level: 9}).length})`;
};
console.log(`  tutte decoder.wasm ${size(join(installed, 'wasm/decoder.wasm'))}, with Draco's attribute mode ` +
  `${size(join(installed, 'wasm/decoder-draco.wasm'))}; draco3d ${size(join(npm, 'draco3d/draco_decoder.wasm'))} ` +
  `and its JavaScript ${size(join(npm, 'draco3d/draco_decoder_nodejs.js'))}; ` +
  `meshoptimizer ${size(join(npm, 'meshoptimizer/meshopt_decoder.mjs'))}\n`);
console.log('Best decoding time in ms, and our speed as a multiple of draco3d\'s (compression level 10 | 7); bytes:');
console.log('| model | triangles | tutte B | draco 10 B | draco 7 B | meshopt B | where | tutte | draco 10 | draco 7 | meshopt | x 10 | x 7 |');
console.log('|---|---|---|---|---|---|---|---|---|---|---|---|---|');
let failures = 0;
for (const file of files.filter((path) => existsSync(path))) {
  const input = await inputsOf(file, profile);
  const places = {node: await measure(input, decoders, seconds)};
  if (page) places.chromium = await page.evaluate(([text, time]) => globalThis.measure(text, time), [JSON.stringify(input, encode), seconds]);
  for (const [place, {times, hash, expected}] of Object.entries(places)) {
    const meshopt = input.meshopt.reduce((sum, stream) => sum + stream.bytes.length, 0);
    const row = [input.name, input.triangles, input.tutte.payload.length, input.draco10.bytes.length, input.draco7.bytes.length,
      meshopt, place, ...['tutte', 'draco10', 'draco7', 'meshopt'].map((name) => times[name].toFixed(2)),
      (times.draco10 / times.tutte).toFixed(2), (times.draco7 / times.tutte).toFixed(2)];
    console.log(`| ${row.join(' | ')} |`);
    if (hash !== expected) {
      ++failures;
      console.error(`${input.name}: in ${place} the decoded data is not the native decoder's`);
    }
  }
}
await started?.close();
process.exit(failures === 0 ? 0 : 1);
