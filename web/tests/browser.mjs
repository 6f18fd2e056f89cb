// Debian's Chromium, driven by playwright-core, on pages that a server of ours gives out.
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';

import {installed, npm, scratch, tests} from './places.mjs';
import {serve} from './server.mjs';

const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const flags = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader', '--enable-precise-memory-info', '--js-flags=--expose-gc'];

/** Ends the program with 77 where there is no browser. */
export function needBrowser() {
  if (existsSync(chromium)) return;
  console.log('skipped: there is no Chromium; ./dev test installs it');
  process.exit(77);
}

/** A browser and a server, of more folders if need be. Close both with close(). @param {Record<string, string>} folders */
export async function startBrowser(folders = {}) {
  const {chromium: engine} = createRequire(join(npm, 'x.js'))('playwright-core');
  const browser = await engine.launch({executablePath: chromium, headless: true, args: flags});
  const server = await serve({npm, 'tutte-gltf': installed, models: scratch, pages: join(tests, 'pages'), ...folders});
  const close = async () => {
    await browser.close();
    server.close();
  };
  return {browser, server, close};
}

/**
 * Opens a page of tests/pages. What it logs as an error, and does not expect, fails the test.
 * @param {{browser: any, server: any}} started
 * @param {string} name
 */
export async function openPage({browser, server}, name, folder = 'pages') {
  const page = await browser.newPage({viewport: {width: 320, height: 240}});
  /** @type {string[]} */
  const problems = [];
  page.on('pageerror', (/** @type {Error} */ error) => problems.push(String(error)));
  await page.goto(`${server.url}/${folder}/${name}`);
  try {
    await page.waitForFunction(() => /** @type {any} */ (globalThis).ready, null, {timeout: 60000});
  } catch (error) {
    throw new Error(`${name} did not start: ${problems.join('; ') || error}`);
  }
  return {page, problems};
}

/**
 * How much two pictures (RGBA, as number arrays) differ: the share of pixels whose colours differ by more than `tolerance`.
 * @param {number[]} a @param {number[]} b
 */
export function difference(a, b, tolerance = 24) {
  if (a.length !== b.length) return 1;
  let count = 0;
  for (let i = 0; i < a.length; i += 4) {
    const most = Math.max(Math.abs(a[i] - b[i]), Math.abs(a[i + 1] - b[i + 1]), Math.abs(a[i + 2] - b[i + 2]));
    if (most > tolerance) ++count;
  }
  return count / (a.length / 4);
}

/** How many pixels are not the background. @param {number[]} picture */
export function drawn(picture) {
  let count = 0;
  for (let i = 0; i < picture.length; i += 4) {
    if (picture[i] !== picture[0] || picture[i + 1] !== picture[1] || picture[i + 2] !== picture[2]) ++count;
  }
  return count;
}

/** How many different colours there are. @param {number[]} picture */
export function coloursOf(picture) {
  const colours = new Set();
  for (let i = 0; i < picture.length; i += 4) colours.add(picture[i] << 16 | picture[i + 1] << 8 | picture[i + 2]);
  return colours.size;
}
