// Babylon.js in Chromium: what its loader makes of compressed files is what it makes of plain ones.
//
//   node babylon.mjs TUTTE BUILD_FOLDER
import {join} from 'node:path';
import {after, before} from 'node:test';

import {needBrowser, openPage, startBrowser} from './browser.mjs';
import {loaderTests} from './loader_tests.mjs';
import {models} from './models.mjs';
import {need, npm} from './places.mjs';

need(join(npm, 'babylonjs'), join(npm, 'playwright-core'));
needBrowser();

/** @type {any} */
let started, opened;
before(async () => {
  started = await startBrowser();
  opened = await openPage(started, 'babylon.html');
});
after(() => started.close());

const show = (url, decoder) => opened.page.evaluate(([url, decoder]) => globalThis.show(url, decoder), [url, decoder]);

const loadMany = (url, times) => opened.page.evaluate(([url, times]) => globalThis.loadMany(url, 'pool', times), [url, times]);

loaderTests({show, loadMany, models: models(), started: () => started, opened: () => opened});
