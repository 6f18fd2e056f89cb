// The viewer in Chromium: what it shows, says and stores, by mouse, by keys, and with files that are broken.
//
//   node viewer.mjs TUTTE BUILD_FOLDER
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, afterEach, before} from 'node:test';

import {needBrowser, startBrowser} from './browser.mjs';
import {need, npm, scratch, tutte, viewer} from './places.mjs';

need(join(npm, 'playwright-core'), join(npm, 'axe-core'), join(viewer, 'app.js'));
needBrowser();

/** A pentagon, a quad and a triangle in a row. */
const house =
  'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 1.5 0\nv 2 0 0.5\nv 2 1 .5\nv 3 .5 1\nf 1 2 3 5 4\nf 2 6 7 3\nf 6 8 7\n';

/** @type {any} */ let started;
/** @type {any} */ let page;
/** @type {string[]} */ let problems, requested;

// One page for most tests: a browser's first seconds on a page are the slow ones.
before(async () => {
  started = await startBrowser({viewer});
  await open();
});
after(() => started.close());
afterEach(() => assert.deepEqual(problems.splice(0), []));

async function open(options = {}) {
  await page?.close();
  problems = [];
  requested = [];
  page = await started.browser.newPage({viewport: {width: 1000, height: 700}, ...options});
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') problems.push(message.text());
  });
  page.on('request', (request) => requested.push(request.url()));
  await page.goto(`${started.server.url}/viewer/index.html?example=Hexagons and 12 pentagons`);
  await finished();
}

/** Until the model at hand is stored in every way, or refused. */
const finished = () => page.waitForSelector('#report[aria-busy=false]', {timeout: 120000});

/** @param {...[string, string | Buffer]} files  names and contents */
async function give(...files) {
  await page.setInputFiles(
    '#picker',
    files.map(([name, content]) => ({name, mimeType: 'application/octet-stream', buffer: Buffer.from(content)}))
  );
  await finished();
}

const text = (selector) => page.textContent(selector);
const picture = async () => (await page.locator('#canvas').screenshot()).toString('base64');

async function downloaded() {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#download')]);
  const file = join(scratch, 'downloaded.glb');
  await download.saveAs(file);
  return file;
}

function written(name, content) {
  const file = join(scratch, name);
  writeFileSync(file, content);
  return file;
}

const run = (...words) => execFileSync(tutte, words, {encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']});

test('an example is shown and stored in every way, with requests to this server only', async () => {
  assert.match(await text('#facts'), /vertices · .*(quads|n.gons)/);
  assert.equal(await page.locator('#sizes .row').count(), 4);
  assert.ok(!(await text('#sizes')).includes('failed'), await text('#sizes'));
  assert.match(await text('#status'), /instead of/);
  assert.ok(
    requested.every((url) => url.startsWith(started.server.url) || url.startsWith('blob:')),
    requested.join('\n')
  );
});

test('every example works', async () => {
  const names = await page.$$eval('#example option', (options) => options.map((option) => option.textContent));
  for (const name of names.slice(1)) {
    await page.selectOption('#example', name);
    await finished();
    assert.equal(await text('#name'), name);
    assert.ok(!(await text('#sizes')).includes('failed'), `${name}: ${await text('#sizes')}`);
  }
});

test('an OBJ file keeps its polygons through compression and download', async () => {
  await give(['house.obj', house]);
  assert.equal(await text('#facts'), '8 vertices · 1 triangle · 1 quad · 1 n\u2011gon of 5 corners');
  const file = await downloaded();
  assert.match(run('verify', written('house.obj', house), file), /same: 3 polygons/);
  assert.match(run('validate', file), /valid/);
});

test('a file can be dropped anywhere', async () => {
  await page.evaluate((content) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([content], 'dropped.obj'));
    document.body.dispatchEvent(new DragEvent('dragover', {dataTransfer: transfer, bubbles: true, cancelable: true}));
    if (document.getElementById('drop').hidden) throw new Error('nothing says that it may be dropped');
    document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: transfer, bubbles: true, cancelable: true}));
  }, house);
  await finished();
  assert.equal(await text('#name'), 'dropped');
  assert.ok(await page.isHidden('#drop'));
});

test('the precision is the one that was chosen', async () => {
  await give(['house.obj', house]);
  await page.click('#precision summary');
  await page.fill('#bits-POSITION', '8');
  await page.press('#bits-POSITION', 'Enter');
  await finished();
  assert.match(run('verify', '--qp', '8', written('house.obj', house), await downloaded()), /same/);
  await page.fill('#bits-POSITION', '14');
  await page.press('#bits-POSITION', 'Enter');
  await finished();
});

test('every bit is kept, or an error bound, on request', async () => {
  await give(['house.obj', house]);
  await page.selectOption('#exactness', 'lossless');
  await finished();
  assert.match(run('verify', '--exact', written('house.obj', house), await downloaded()), /same/);
  assert.match(await text('#size-note'), /every bit kept/);
  await page.selectOption('#exactness', 'error');
  await finished();
  assert.match(await text('#size-note'), /at most 0.01 %/);
  assert.ok(!(await text('#sizes')).includes('failed'), await text('#sizes'));
  await page.selectOption('#exactness', 'bits');
  await finished();
});

test('a compressed file is shown with its polygons and stored anew', async () => {
  const file = join(scratch, 'house.glb');
  run('encode', written('house.obj', house), file);
  await give(['house.glb', readFileSync(file)]);
  assert.equal(await text('#facts'), '8 vertices · 1 triangle · 1 quad · 1 n\u2011gon of 5 corners');
  assert.match(await text('#sizes .original'), /Uncompressed/);
  assert.match(run('verify', file, await downloaded()), /same/);
});

test('a .gltf file comes with the files that it names, or says which one is missing', async () => {
  const file = join(scratch, 'parts.gltf');
  run('decode', compressedHouse(), file);
  const parts = [
    ['parts.gltf', readFileSync(file)],
    ['parts.bin', readFileSync(join(scratch, 'parts.bin'))],
  ];
  await give(...parts);
  assert.match(await text('#facts'), /1 n.gon of 5 corners/);
  await give(parts[0]);
  assert.equal(await text('#alert'), 'parts.gltf needs parts.bin too: open both together');
});

function compressedHouse() {
  const file = join(scratch, 'house.glb');
  run('encode', written('house.obj', house), file);
  return file;
}

test('broken files give a message, and the page goes on', async () => {
  const damaged = readFileSync(compressedHouse());
  damaged[damaged.indexOf('TUTT\0') + 40] ^= 255;
  for (const [name, content] of [
    ['text.glb', 'hello'],
    ['empty.obj', ''],
    ['index.obj', 'v 0 0 0\nf 1 2 3\n'],
    ['damaged.glb', damaged],
    ['cut.glb', readFileSync(compressedHouse()).subarray(0, 300)],
    ['picture.png', 'x'],
  ]) {
    await give([name, content]);
    assert.notEqual(await text('#alert'), '', name);
  }
  await give(['house.obj', house]);
  assert.ok(await page.isHidden('#alert'));
  assert.match(await text('#status'), /house/);
});

/** Waits until the picture is, or is not, that one. */
async function expectPicture(is, that) {
  for (const end = Date.now() + 20000; ((await picture()) === that) !== is;) {
    assert.ok(Date.now() < end, is ? 'the picture is another' : 'the picture is the same');
    await page.waitForTimeout(100);
  }
}

test('keys turn, zoom and reset the model', async () => {
  await give(['house.obj', house]);
  await page.focus('#canvas');
  await page.keyboard.press('0');
  await page.waitForTimeout(1000);
  const first = await picture();
  for (const key of ['ArrowRight', 'ArrowUp', '+', '-']) {
    const before = await picture();
    await page.keyboard.press(key);
    await expectPicture(false, before);
  }
  await page.keyboard.press('0');
  await expectPicture(true, first);
});

test('keys choose what is shown', async () => {
  await give(['house.obj', house]);
  await page.focus('#sizes input:checked');
  await page.keyboard.press('ArrowDown');
  await page.waitForFunction(() => document.getElementById('facts').textContent === '8 vertices · 6 triangles');
  assert.equal(await page.evaluate(() => document.activeElement.value), 'draco');
});

test('polygon edges can be hidden', async () => {
  await give(['house.obj', house]);
  const first = await picture();
  await page.uncheck('#edges');
  await expectPicture(false, first);
  await page.check('#edges');
});

for (const colorScheme of ['light', 'dark']) {
  test(`nothing stands in the way of assistive technology, ${colorScheme}`, async () => {
    await open({colorScheme, bypassCSP: true});
    await page.click('#precision summary');
    await page.addScriptTag({path: join(npm, 'axe-core/axe.min.js')});
    const {violations} = await page.evaluate(() => /** @type {any} */ (globalThis).axe.run());
    assert.deepEqual(
      violations.map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html).join(' ')}`),
      []
    );
  });
}

test('a narrow window needs no sideways scrolling', async () => {
  await page.setViewportSize({width: 320, height: 640});
  await page.waitForTimeout(300);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
});

test('the theme can be chosen, and is remembered', async () => {
  await open({colorScheme: 'light'});
  const page_color = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await page_color();
  await page.click('#theme');
  await page.click('#theme');
  const dark = await page_color();
  assert.notEqual(dark, light);
  await page.reload();
  await finished();
  assert.equal(await page_color(), dark);
});
