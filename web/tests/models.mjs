// Models for the tests: made here, of Debian's assimp-testmodels, and of the corpus where it is present.
import {execFileSync} from 'node:child_process';
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import {basename, extname, join} from 'node:path';

import {assimpModels, corpus, scratch, tutte} from './places.mjs';

/** A torus of quads with texture coordinates, so with seams, and normals. */
function torus(columns, rows) {
  const lines = [];
  for (let y = 0; y <= rows; ++y) {
    for (let x = 0; x <= columns; ++x) {
      const a = 2 * Math.PI * x / columns, b = 2 * Math.PI * y / rows;
      const r = 2 + 0.8 * Math.cos(b);
      if (x < columns && y < rows) {
        lines.push(`v ${r * Math.cos(a)} ${r * Math.sin(a)} ${0.8 * Math.sin(b)}`);
        lines.push(`vn ${Math.cos(a) * Math.cos(b)} ${Math.sin(a) * Math.cos(b)} ${Math.sin(b)}`);
      }
      lines.push(`vt ${x / columns} ${y / rows}`);
    }
  }
  const vertex = (x, y) => (y % rows) * columns + x % columns + 1;
  const texcoord = (x, y) => y * (columns + 1) + x + 1;
  for (let y = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x) {
      const corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
      lines.push('f ' + corners.map(([i, j]) => `${vertex(i, j)}/${texcoord(i, j)}/${vertex(i, j)}`).join(' '));
    }
  }
  return lines;
}

/** Hexagons, flat, with every polygon in one plane: nothing but connectivity. */
function comb(columns, rows) {
  const lines = [], known = new Map();
  const vertex = (x, y) => {
    const key = `${Math.round(1000 * x)} ${Math.round(1000 * y)}`;
    if (!known.has(key)) {
      known.set(key, known.size + 1);
      lines.push(`v ${x} ${y} ${0.2 * Math.sin(x) * Math.cos(y)}`);
    }
    return known.get(key);
  };
  const faces = [];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const cx = Math.sqrt(3) * (column + (row % 2) / 2), cy = 1.5 * row;
      const corners = [];
      for (let i = 0; i < 6; ++i) {
        const angle = Math.PI / 3 * i + Math.PI / 6;
        corners.push(vertex(cx + Math.cos(angle), cy + Math.sin(angle)));
      }
      faces.push(`f ${corners.join(' ')}`);
    }
  }
  return [...lines, ...faces];
}

function generated(name, lines) {
  const file = join(scratch, `${name}.obj`);
  writeFileSync(file, lines.join('\n') + '\n');
  return file;
}

/** A source model in every form that the tests look at. */
export class Model {
  /** @param {string} source @param {string[]} [options] of tutte encode */
  constructor(source, options = []) {
    this.source = source;
    this.name = basename(source, extname(source)) + options.map((option) => option.replace(/^-*/, '-')).join('');
    this.options = options;
  }

  #make(suffix, command) {
    const file = join(scratch, `${this.name}${suffix}`);
    if (!existsSync(file)) execFileSync(tutte, command(file), {stdio: ['ignore', 'ignore', 'pipe']});
    return file;
  }

  /** The file with TUTTE_mesh_compression. */
  get compressed() {
    return this.#make('.glb', (file) => ['encode', this.source, file, ...this.options]);
  }

  /** What the native decoder makes of it: without the extension. */
  get plain() {
    return this.#make('.plain.glb', (file) => ['decode', this.compressed, file]);
  }

  compressedBytes() {
    return new Uint8Array(readFileSync(this.compressed));
  }

  plainBytes() {
    return new Uint8Array(readFileSync(this.plain));
  }
}

const ownAttributes = ['--attribute-coder', 'tutte'], dracoAttributes = ['--attribute-coder', 'draco'];

/** A few models of different kinds, quick to test. */
export function models() {
  const ring = generated('torus', torus(48, 24)), hexagons = generated('comb', comb(20, 15));
  const sources = [
    new Model(ring, ownAttributes), new Model(ring, dracoAttributes), new Model(ring, ['--polygons', 'both']),
    new Model(hexagons, ['--polygons', 'ext']), new Model(hexagons),
  ];
  for (const path of [
    join(assimpModels, 'Collada/duck.dae'), join(assimpModels, 'OBJ/spider.obj'),
    join(corpus, 'gltf/Fox/Fox.gltf'), join(corpus, 'gltf/CesiumMan.glb'), join(corpus, 'gltf/AnimatedMorphCube/AnimatedMorphCube.gltf'),
  ]) {
    if (existsSync(path)) sources.push(new Model(path));
    else console.log(`# skipped: there is no ${path}`);
  }
  return sources;
}
