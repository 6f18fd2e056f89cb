// Everything that tutte writes, seen by the Khronos validator: no error and no warning that its input had not.
//
//   node validate.mjs TUTTE NODE_MODULES_FOLDER OUTPUT_FOLDER
//
// Inputs: models made below, the glTF models of Debian's assimp-testmodels, and the corpus (TUTTE_CORPUS or
// ../shared/corpus beside the project) where they exist. Exit code 77: gltf-validator is not installed (see ./dev).

import {spawnSync} from 'node:child_process';
import {existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {basename, dirname, extname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const [tutte, modules, output] = process.argv.slice(2);
const project = resolve(dirname(fileURLToPath(import.meta.url)), '../../..');
const corpus = process.env.TUTTE_CORPUS ?? join(project, '../shared/corpus');
const inputFolders = ['/usr/share/assimp/models/glTF2', join(corpus, 'gltf')];
const variants = {plain: [], fallback: ['--fallback'], polygons: ['--polygons', 'both']};

const validator = loadValidator();
rmSync(output, {recursive: true, force: true});
mkdirSync(output, {recursive: true});
const failures = [], refusals = [];
let files = 0;
for (const input of [...generatedModels(), ...inputFolders.flatMap(modelsBelow)]) await checkModel(input);
for (const refusal of refusals) console.log(`refused: ${refusal}`);
for (const failure of failures) console.error(`FAILED: ${failure}`);
console.log(`${files} files validated, ${refusals.length} inputs refused, ${failures.length} failures`);
process.exit(failures.length === 0 ? 0 : 1);

function loadValidator() {
  if (!existsSync(join(modules, 'node_modules/gltf-validator'))) {
    console.log('gltf-validator is not installed: run ./dev test');
    process.exit(77);
  }
  return createRequire(join(resolve(modules), 'package.json'))('gltf-validator');
}

/** Encodes one model in every variant and decodes it again; each file must be no worse than the input. */
async function checkModel(input) {
  const known = await problemCodes(input);
  for (const [variant, options] of Object.entries(variants)) {
    const name = `${basename(dirname(input))}-${basename(input, extname(input))}-${variant}`;
    const encoded = join(output, `${name}.glb`), decoded = join(output, `${name}-decoded.glb`);
    const run = spawnSync(tutte, ['encode', input, encoded, ...options], {encoding: 'utf8'});
    if ([2, 3, 5].includes(run.status)) {  // invalid, unsupported, or a file is missing
      refusals.push(`${input} (${run.status}): ${run.stderr.trim().split('\n')[0]}`);
      return;
    }
    if (run.status !== 0) {
      failures.push(`${name}: encode ended with ${run.status ?? run.signal}: ${run.stderr.trim()}`);
      return;
    }
    await checkFile(encoded, known);
    const back = spawnSync(tutte, ['decode', encoded, decoded], {encoding: 'utf8'});
    if (back.status !== 0) failures.push(`${name}: decode ended with ${back.status ?? back.signal}: ${back.stderr.trim()}`);
    else await checkFile(decoded, known);
  }
}

async function checkFile(file, known) {
  ++files;
  for (const problem of await problems(file)) {
    if (!known.has(problem.code)) failures.push(`${file}: ${problem.code} ${problem.pointer}: ${problem.message}`);
  }
}

async function problemCodes(input) {
  if (!['.glb', '.gltf'].includes(extname(input).toLowerCase())) return new Set();
  return new Set((await problems(input)).map(problem => problem.code));
}

/** The errors and warnings of a glTF file. */
async function problems(file) {
  const externalResourceFunction = uri => new Promise((done, fail) => {
    try {
      done(new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))));
    } catch (error) {
      fail(error.message);
    }
  });
  try {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {externalResourceFunction});
    return report.issues.messages.filter(message => message.severity <= 1);
  } catch (error) {
    return [{code: 'UNREADABLE', pointer: '', message: String(error)}];
  }
}

function modelsBelow(folder) {
  if (!existsSync(folder)) {
    console.log(`skipped: there is no ${folder}`);
    return [];
  }
  return readdirSync(folder, {recursive: true})
      .filter(name => ['.glb', '.gltf'].includes(extname(name).toLowerCase()))
      .map(name => join(folder, name));
}

/** A few OBJ files: seams, n-gons, holes, several components, dirt. */
function generatedModels() {
  const write = (name, lines) => {
    const file = join(output, `${name}.obj`);
    writeFileSync(file, lines.join('\n') + '\n');
    return file;
  };
  return [
    write('cube', cube()),
    write('prism', prism(7)),
    write('sheet', sheet(20, 300)),
    write('book', ['v 0 0 0', 'v 0 0 1', 'v 1 0 0', 'v 0 1 0', 'v 1 1 0', 'f 1 2 3', 'f 1 2 4', 'f 1 2 5']),
    write('concave', ['v 0 0 0', 'v 4 0 0', 'v 4 4 0', 'v 2 1 0', 'v 0 4 0', 'f 1 2 3 4 5']),
  ];
}

/** Every face has its own square of the texture and its own normal: every edge is a seam. */
function cube() {
  const lines = [];
  for (let i = 0; i < 8; ++i) lines.push(`v ${i & 1} ${i >> 1 & 1} ${i >> 2}`);
  for (const uv of ['0 0', '1 0', '1 1', '0 1']) lines.push(`vt ${uv}`);
  for (const normal of ['0 0 -1', '0 0 1', '0 -1 0', '0 1 0', '-1 0 0', '1 0 0']) lines.push(`vn ${normal}`);
  const faces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
  faces.forEach((face, n) => lines.push('f ' + face.map((v, i) => `${v}/${i + 1}/${n + 1}`).join(' ')));
  return lines;
}

function prism(sides) {
  const lines = [], bottom = [], top = [];
  for (const z of [0, 1]) {
    for (let i = 0; i < sides; ++i) {
      const angle = 2 * Math.PI * i / sides;
      lines.push(`v ${Math.cos(angle)} ${Math.sin(angle)} ${z}`);
    }
  }
  for (let i = 0; i < sides; ++i) {
    const j = (i + 1) % sides;
    lines.push(`f ${i + 1} ${j + 1} ${sides + j + 1} ${sides + i + 1}`);
    bottom.unshift(i + 1);
    top.push(sides + i + 1);
  }
  return [...lines, `f ${bottom.join(' ')}`, `f ${top.join(' ')}`];
}

/** Quads; more vertices than an unsigned byte counts, and with `columns` * `rows` > 65535 than a short does. */
function sheet(columns, rows) {
  const lines = [];
  for (let y = 0; y <= rows; ++y) {
    for (let x = 0; x <= columns; ++x) {
      lines.push(`v ${x} ${y} ${Math.sin(x * y)}`, `vt ${x / columns} ${y / rows}`);
    }
  }
  for (let y = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x) {
      const a = y * (columns + 1) + x + 1, b = a + columns + 1;
      lines.push('f ' + [a, a + 1, b + 1, b].map(i => `${i}/${i}`).join(' '));
    }
  }
  return lines;
}
