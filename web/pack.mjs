// Puts the npm package together: sources, the modules that ./dev wasm has built, and these as JavaScript too.
//
//   node pack.mjs WASM_FOLDER OUTPUT_FOLDER     afterwards OUTPUT_FOLDER/tutte-gltf.tgz is what npm would publish
import {execFileSync} from 'node:child_process';
import {cpSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const [wasmFolder, output] = process.argv.slice(2).map((folder) => resolve(folder));
const web = dirname(fileURLToPath(import.meta.url));
const folder = join(output, 'tutte-gltf');

rmSync(folder, {recursive: true, force: true});
mkdirSync(output, {recursive: true});
cpSync(join(web, 'package'), folder, {recursive: true});
cpSync(join(web, '../LICENSE'), join(folder, 'LICENSE'));
mkdirSync(join(folder, 'wasm'), {recursive: true});
for (const name of ['decoder', 'decoder-draco', 'encoder']) {
  const bytes = readFileSync(join(wasmFolder, `${name}.wasm`));
  writeFileSync(join(folder, 'wasm', `${name}.wasm`), bytes);
  writeFileSync(join(folder, 'wasm', `${name}.js`), `export default '${bytes.toString('base64')}';\n`);
}
const [{filename}] = JSON.parse(execFileSync('npm', ['pack', '--json', '--pack-destination', output], {cwd: folder}));
renameSync(join(output, filename), join(output, 'tutte-gltf.tgz'));
