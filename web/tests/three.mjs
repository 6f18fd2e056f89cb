// three.js in Chromium: what GLTFLoader makes of compressed files is what it makes of plain ones.
//
//   node three.mjs TUTTE BUILD_FOLDER
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, before} from 'node:test';

import {needBrowser, openPage, startBrowser} from './browser.mjs';
import {loaderTests} from './loader_tests.mjs';
import {models} from './models.mjs';
import {need, npm} from './places.mjs';

need(join(npm, 'three'), join(npm, 'playwright-core'));
needBrowser();

const all = models();
/** @type {any} */
let started, opened;
before(async () => {
  started = await startBrowser();
  opened = await openPage(started, 'three.html');
});
after(() => started.close());

const show = (url, decoder, edges = false) =>
  opened.page.evaluate(([url, decoder, edges]) => globalThis.show(url, decoder, edges), [url, decoder, edges]);

const loadMany = (url, times) => opened.page.evaluate(([url, times]) => globalThis.loadMany(url, 'pool', times), [url, times]);
loaderTests({show, loadMany, models: all, started: () => started, opened: () => opened});

/** The edges of an OBJ file's polygons. @param {string} file */
function countEdges(file) {
  const edges = new Set();
  for (const line of readFileSync(file, 'utf8').split('\n').filter((text) => text.startsWith('f '))) {
    const corners = line.slice(2).split(' ').map(Number);
    corners.forEach((a, i) => edges.add([a, corners[(i + 1) % corners.length]].sort((x, y) => x - y).join(' ')));
  }
  return edges.size;
}

test('polygon edges are those of the polygons', async () => {
  const edgesOf = async (model, decoder) => (await show(`/models/${model.name}.glb`, decoder, true)).edges;
  const [ring, , both, ext, fans] = all;
  // 48 x 24 quads with a seam both ways, whose edges are there once.
  for (const model of [ring, both]) assert.equal(await edgesOf(model, 'pool'), 2 * 48 * 24, model.name);
  for (const model of [ext, fans]) assert.equal(await edgesOf(model, 'pool'), countEdges(model.source), model.name);
});

test('polygon edges are drawn', async () => {
  const {picture: without} = await show(`/models/${all[0].name}.glb`, 'pool');
  const {picture: edges} = await show(`/models/${all[0].name}.glb`, 'pool', true);
  const yellow = (picture) => {
    let count = 0;
    for (let i = 0; i < picture.length; i += 4) count += Number(picture[i] > 200 && picture[i + 1] > 200 && picture[i + 2] < 60);
    return count;
  };
  assert.equal(yellow(without), 0);
  assert.ok(yellow(edges) > 500, `${yellow(edges)} pixels`);
});
