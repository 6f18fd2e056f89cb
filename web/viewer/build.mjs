// Bundles the viewer, and makes its examples of Debian's assimp-testmodels:
//
//   node build.mjs NODE_MODULES TUTTE_GLTF OUTPUT TUTTE MODELS
//
// TUTTE_GLTF is the folder of the package, TUTTE the command, MODELS the folder of the models.
import {execFileSync} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const [modules, tutte, output, command, models] = process.argv.slice(2).map((path) => resolve(path));
const viewer = dirname(fileURLToPath(import.meta.url));
const {build} = createRequire(join(modules, 'x.js'))('esbuild');

/** The package is not installed here, so its own imports, and those of its imports, have to be led. */
const lead = {
  name: 'lead',
  setup({onResolve, resolve: find}) {
    onResolve({filter: /^tutte-gltf/}, ({path}) => ({path: join(tutte, 'src', `${path.split('/')[1] ?? 'index'}.js`)}));
    onResolve({filter: /^(node:)?(fs|path|crypto|worker_threads|url)$/}, ({path}) => ({path, external: true}));
  },
};

rmSync(output, {recursive: true, force: true});
mkdirSync(output, {recursive: true});
await build({
  entryPoints: {
    app: join(viewer, 'src/app.js'),
    work: join(viewer, 'src/work.js'),
    worker: join(tutte, 'src/worker.js'),
  },
  bundle: true,
  format: 'esm',
  splitting: true,
  minify: true,
  target: 'es2022',
  outdir: output,
  chunkNames: 'part-[hash]',
  nodePaths: [modules],
  plugins: [lead],
  legalComments: 'linked',
  logLevel: 'warning',
});
for (const name of ['index.html', 'style.css', 'icon.svg']) cpSync(join(viewer, name), join(output, name));
for (const name of ['draco_decoder_gltf.wasm', 'draco_encoder.wasm'])
  cpSync(join(modules, 'draco3dgltf', name), join(output, name));

// Plain files with polygons, without loss: what the page compresses is not compressed already.
mkdirSync(join(output, 'examples'));
const examples = [];
for (const [name, source] of [
  ['Duck', 'Collada/duck.dae'],
  ['Human', 'Collada/human.zae'],
  ['Spider', 'OBJ/spider.obj'],
]) {
  const file = `examples/${name.toLowerCase()}.glb`,
    [path, compressed] = [join(output, file), join(output, 'compressed.glb')];
  if (!existsSync(join(models, source))) continue;
  const run = (...words) => execFileSync(command, words, {stdio: ['ignore', 'ignore', 'pipe']});
  run('encode', '--qp', '0', '--qn', '0', '--qt', '0', join(models, source), compressed);
  run('decode', compressed, path);
  rmSync(compressed);
  examples.push({name, file});
}
writeFileSync(join(output, 'examples.json'), JSON.stringify(examples));
