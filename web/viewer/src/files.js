import {imageBytes, isGlb, sizesOf, withInside} from './glb.js';
import {readObj} from './obj.js';
import {glbOf} from './polygons.js';

/**
 * A model as it was given, in one file or in one and those beside it. Its sizes are without images.
 * @typedef {{name: string, size: number, zipped: number, glb: Uint8Array}} Model
 */

/** @param {FileList | File[]} list @returns {Promise<Model>} */
export async function modelOf(list) {
  const files = [...list];
  const main = files.find((file) => /\.(glb|gltf|obj)$/i.test(file.name));
  if (!main) throw new Error('Open a .glb, .gltf or .obj file');
  const bytes = new Uint8Array(await main.arrayBuffer());
  const name = main.name.replace(/\.[^.]*$/, '');
  if (/\.obj$/i.test(main.name)) {
    return {name, ...(await sizesOf(bytes, 0)), glb: glbOf(readObj(new TextDecoder().decode(bytes), name))};
  }
  if (isGlb(bytes)) return {name, ...(await sizesOf(bytes, imageBytes(bytes))), glb: bytes};
  return {name, ...(await withResources(main.name, bytes, files))};
}

/** A .gltf file with the files that it names, from among those that came along. */
async function withResources(name, bytes, files) {
  let json;
  try {
    json = JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    throw new Error(`${name} is neither GLB nor JSON`);
  }
  const resources = {};
  const buffers = json.buffers ?? [],
    images = json.images ?? [];
  for (const {uri} of [...buffers, ...images]) {
    if (!uri || uri.startsWith('data:')) continue;
    const wanted = decodeURIComponent(uri).split('/').pop();
    const file = files.find((candidate) => candidate.name === wanted);
    if (!file) throw new Error(`${name} needs ${wanted} too: open both together`);
    resources[uri] = new Uint8Array(await file.arrayBuffer());
  }
  const parts = [bytes, ...buffers.map(({uri}) => resources[uri] ?? new Uint8Array(0))];
  const sizes = await Promise.all(parts.map((part) => sizesOf(part, 0)));
  const sum = (/** @type {'size' | 'zipped'} */ what) => sizes.reduce((all, part) => all + part[what], 0);
  return {glb: withInside(json, resources), size: sum('size'), zipped: sum('zipped')};
}

/** All files of a drop, of folders too. @param {DataTransfer} transfer @returns {Promise<File[]>} */
export async function droppedFiles(transfer) {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (entries.length === 0) return [...transfer.files];
  return (await Promise.all(entries.map(filesBelow))).flat();
}

/** @param {any} entry @returns {Promise<File[]>} */
async function filesBelow(entry) {
  if (entry.isFile) return [await new Promise((resolve, reject) => entry.file(resolve, reject))];
  const reader = entry.createReader(),
    all = [];
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) break;
    all.push(...some);
  }
  return (await Promise.all(all.map(filesBelow))).flat();
}
