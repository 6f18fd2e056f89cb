import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {loadTutte} from 'tutte-gltf';
import {TutteMeshCompression} from 'tutte-gltf/three';
import {generated} from './examples.js';
import {droppedFiles, modelOf} from './files.js';
import {sizesOf} from './glb.js';
import {glbOf} from './polygons.js';
import * as report from './report.js';
import {Stage} from './stage.js';
import {startTheme} from './theme.js';

const ways = {
  tutte: {title: 'Tutte', note: 'polygons kept'},
  draco: {title: 'Draco', note: 'triangles only'},
  meshopt: {title: 'meshopt', note: 'triangles only'},
};
const precisions = {
  POSITION: ['Positions', 14],
  NORMAL: ['Normals', 10],
  TEXCOORD: ['Texture coordinates', 12],
  COLOR: ['Colours', 8],
  GENERIC: ['Other', 12],
};

/** What decides how exact Tutte is; the others know bits only. */
const exactnesses = {
  bits: {title: 'Bits', options: () => ({}), notes: () => []},
  error: {
    title: 'Error bound',
    options: () => ({errors: {position: `${byId('error').valueAsNumber}%`}}),
    notes: () => [`Tutte: positions off by at most ${byId('error').valueAsNumber} % of the model's size.`],
  },
  lossless: {title: 'Every bit', options: () => ({lossless: true}), notes: () => ['Tutte: every bit kept.']},
};
const grids = {file: 'File', mesh: 'Mesh'};

/** @param {string} id @returns {any} */
const byId = (id) => document.getElementById(id);
const stage = new Stage(byId('canvas'));
const tutte = loadTutte();
const worker = new Worker(new URL('./work.js', import.meta.url), {type: 'module'});
const answers = new Map();
let lastId = 0;

worker.onmessage = ({data: {id, result, error}}) => {
  const {resolve, reject} = answers.get(id);
  answers.delete(id);
  error === undefined ? resolve(result) : reject(new Error(error));
};

/** Has the worker do a task. @param {string} task @param {any} details @returns {Promise<any>} */
function ask(task, details) {
  return new Promise((resolve, reject) => {
    answers.set(++lastId, {resolve, reject});
    worker.postMessage({id: lastId, task, ...details});
  });
}

/** The model on the page; a newer one makes what is still under way for an older one void. */
let current = /** @type {any} */ (null);

/** @param {import('./files.js').Model | Promise<import('./files.js').Model>} promised */
async function open(promised) {
  const mine = (current = /** @type {any} */ ({}));
  report.complain('');
  report.busy(true);
  report.say('Opening');
  try {
    mine.model = await promised;
    const {glb, wasCompressed, hasWeights, size, zipped} = await ask('open', mine.model);
    if (mine !== current) return;
    mine.files = {original: glb};
    mine.hasWeights = hasWeights;
    mine.versions = [
      wasCompressed
        ? {id: 'original', title: 'Uncompressed', note: '', size, zipped}
        : {id: 'original', title: 'Original', note: '', size: mine.model.size, zipped: mine.model.zipped},
    ];
    await display('original', false);
    await store();
  } catch (error) {
    if (mine !== current) return;
    report.busy(false);
    report.say('');
    report.complain(String(/** @type {any} */ (error).message ?? error));
  }
}

/** Stores the model in every way, with the precision that the page says. */
async function store() {
  const mine = current;
  const bits = Object.fromEntries(Object.keys(precisions).map((name) => [name, byId(`bits-${name}`).valueAsNumber]));
  const exactness = byId('exactness').value;
  const choice = {grid: byId('grid').value, ...exactnesses[exactness].options()};
  mine.versions.splice(1, Infinity, ...Object.entries(ways).map(([id, way]) => ({id, ...way})));
  mine.times = [];
  mine.warnings = [];
  mine.run = {};
  report.busy(true);
  report.promiseDownload();
  refresh();
  const {run} = mine;
  for (const id of Object.keys(ways)) {
    report.say(`Compressing: ${ways[id].title}`);
    await storeOne(mine, id, bits, choice).catch((error) => {
      Object.assign(
        mine.versions.find((version) => version.id === id),
        {failed: 'failed', note: error.message}
      );
      if (id === 'tutte' && mine === current) report.withdrawDownload();
    });
    if (mine !== current || run !== mine.run) return;
    refresh();
  }
  const precision = `Positions in ${bits.POSITION} bits, normals ${bits.NORMAL}, texture coordinates ${bits.TEXCOORD}.`;
  const weights = mine.hasWeights ? ['Skin weights exactly in Tutte, rounded in the others.'] : [];
  const left = mine.warnings.map((warning) => `Tutte: ${warning}.`);
  report.showSizeNote(['Without textures.', precision, ...exactnesses[exactness].notes(), ...weights, ...left].join(' '));
  summarise(mine);
  report.busy(false);
}

/** @param {any} mine @param {string} id @param {Record<string, number>} bits @param {any} choice */
async function storeOne(mine, id, bits, choice) {
  const {bytes, warnings, shown, size, zipped, ms} = await ask('store', {way: id, bits, choice});
  if (mine !== current) return;
  mine.files[id] = shown;
  Object.assign(
    mine.versions.find((version) => version.id === id),
    {size, zipped}
  );
  mine.warnings.push(...warnings);
  mine.times.push({id, title: ways[id].title, ms});
  if (id !== 'tutte') return;
  report.offerDownload(bytes, `${mine.model.name}.glb`);
  const {sections, vertices} = await ask('describe', {bytes});
  report.showSections(sections, vertices);
  await display('tutte', true);
}

/** @param {any} mine */
function summarise(mine) {
  const [original, stored] = mine.versions;
  if (!stored.size) return report.say('');
  report.say(`${mine.model.name}: ${report.bytesText(stored.size)} instead of ${report.bytesText(original.size)}`);
}

function refresh() {
  report.showSizes(current.versions, byId('zipped').checked ? 'zipped' : 'size', current.shown, (id) =>
    display(id, true)
  );
  report.showTimes(current.times);
}

/** Shows one version of the model. @param {string} id @param {boolean} keepView */
async function display(id, keepView) {
  const mine = current;
  mine.shown = id;
  const loader = new GLTFLoader();
  loader.register((parser) => new TutteMeshCompression(parser, tutte));
  const gltf = await loader.parseAsync(mine.files[id].slice().buffer, '');
  if (mine !== current || mine.shown !== id) return;
  const {degrees, vertices} = await stage.show(gltf, keepView);
  report.showFacts(mine.model.name, vertices, degrees);
  byId('canvas').setAttribute('aria-label', `${mine.model.name}, ${byId('facts').textContent}`);
}

/** A file of the server's. @param {{name: string, file: string}} example */
async function fetched({name, file}) {
  const response = await fetch(new URL(file, document.baseURI));
  if (!response.ok) throw new Error(`${name} could not be loaded`);
  return {...(await modelOf([new File([await response.arrayBuffer()], file)])), name};
}

/** Fills the list of examples and shows the one that the address names (?example=Duck), or the first. */
async function offerExamples() {
  const response = await fetch(new URL('examples.json', document.baseURI));
  const files = response.ok ? await response.json() : [];
  const examples = new Map([
    ...files.map((/** @type {any} */ example) => [example.name, () => fetched(example)]),
    ...Object.entries(generated).map(([name, make]) => [
      name,
      async () => {
        const glb = glbOf(make());
        return {name, glb, ...(await sizesOf(glb, 0))};
      },
    ]),
  ]);
  for (const name of examples.keys()) byId('example').append(new Option(name));
  byId('example').addEventListener('change', () => {
    const make = examples.get(byId('example').value);
    if (make) open(make());
  });
  const asked = new URLSearchParams(location.search).get('example') ?? '';
  byId('example').value = examples.has(asked) ? asked : [...examples.keys()][0];
  open(/** @type {any} */ (examples.get(byId('example').value))());
}

function listen() {
  byId('open').addEventListener('click', () => byId('picker').click());
  byId('picker').addEventListener('change', () => {
    if (byId('picker').files.length > 0) openFiles([...byId('picker').files]);
    byId('picker').value = '';
  });
  byId('zipped').addEventListener('change', () => current?.versions && refresh());
  byId('edges').addEventListener('change', () => stage.showEdges(byId('edges').checked));
  byId('turn').addEventListener('change', () => stage.turn(byId('turn').checked));
  byId('reset').addEventListener('click', () => stage.reset());
  const dragged = (/** @type {boolean} */ shown) => (/** @type {DragEvent} */ event) => {
    event.preventDefault();
    byId('drop').hidden = !shown;
  };
  addEventListener('dragover', dragged(true));
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) dragged(false)(event);
  });
  addEventListener('drop', (event) => {
    dragged(false)(event);
    openFiles(droppedFiles(event.dataTransfer));
  });
}

/** @param {File[] | Promise<File[]>} files */
function openFiles(files) {
  byId('example').selectedIndex = 0;
  open(Promise.resolve(files).then(modelOf));
}

/** What decides how exact the compressed model is. Changing it compresses anew. */
function offerPrecision() {
  const form = byId('bits');
  const titles = Object.entries(exactnesses).map(([value, {title}]) => [value, title]);
  form.append(labelled('Tutte keeps', choiceOf('exactness', titles)));
  form.append(labelled('Largest error, % of the size', numberFor('error', 0.01, 0.0001, 10, 'any')));
  form.append(labelled('Rounded alike per', choiceOf('grid', Object.entries(grids))));
  for (const [name, [title, bits]] of Object.entries(precisions)) {
    form.append(labelled(title, numberFor(`bits-${name}`, bits, 6, 16, 1)));
  }
  enableWhatCounts();
  form.addEventListener('change', (/** @type {Event} */ event) => {
    enableWhatCounts();
    if (/** @type {any} */ (event.target).reportValidity() && current?.versions) store();
  });
  form.addEventListener('submit', (/** @type {Event} */ event) => event.preventDefault());
}

function enableWhatCounts() {
  byId('error').disabled = byId('exactness').value !== 'error';
  byId('grid').disabled = byId('exactness').value === 'lossless';
}

/** @param {string} title @param {HTMLElement} input */
function labelled(title, input) {
  const label = document.createElement('label');
  label.append(title, input);
  return label;
}

/** @param {string} id @param {number} value @param {number} min @param {number} max @param {number | 'any'} step */
function numberFor(id, value, min, max, step) {
  return Object.assign(document.createElement('input'), {type: 'number', id, min, max, step, value});
}

/** @param {string} id @param {string[][]} options  values and titles */
function choiceOf(id, options) {
  const select = Object.assign(document.createElement('select'), {id});
  for (const [value, title] of options) select.append(new Option(title, value));
  return select;
}

startTheme(byId('theme'), () => stage.recolor());
offerPrecision();
listen();
offerExamples();
