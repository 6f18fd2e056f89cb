// The loaders' tests for a library that a page of its own wraps: pages/NAME.html offers show() and loadMany().
import {join} from 'node:path';
import {after, before} from 'node:test';

import {needBrowser, openPage, startBrowser} from './browser.mjs';
import {loaderTests} from './loader_tests.mjs';
import {models} from './models.mjs';
import {need, npm} from './places.mjs';

/** @param {string} library  its npm package @param {string} html  its page */
export function testLoaderPage(library, html) {
  need(join(npm, library), join(npm, 'playwright-core'));
  needBrowser();

  /** @type {any} */
  let started, opened;
  before(async () => {
    started = await startBrowser();
    opened = await openPage(started, html);
  });
  after(() => started.close());

  const show = (url, decoder) => opened.page.evaluate(([url, decoder]) => globalThis.show(url, decoder), [url, decoder]);
  const loadMany = (url, times) => opened.page.evaluate(([url, times]) => globalThis.loadMany(url, 'pool', times), [url, times]);

  loaderTests({show, loadMany, models: models(), started: () => started, opened: () => opened});
}
