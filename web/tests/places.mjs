// Where the tests find what they need, from the command line: TUTTE BUILD_FOLDER. Exit code 77: something is missing.
import {existsSync, mkdirSync, rmSync} from 'node:fs';
import {basename, dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const [tutteArgument, buildArgument] = process.argv.slice(2);

/** The folder of these tests. */
export const tests = dirname(fileURLToPath(import.meta.url));
/** The native command, to compress and decompress with. */
export const tutte = resolve(tutteArgument);
const build = resolve(buildArgument);
/** npm's packages that only tests need. */
export const npm = join(build, 'web-npm/node_modules');
/** A project with nothing in it but the packed package. */
export const project = join(build, 'web/project');
/** The package as installed there. */
export const installed = join(project, 'node_modules/tutte-gltf');
/** The page of web/viewer. */
export const viewer = join(build, 'viewer');
/** Models of Debian's assimp-testmodels, and of the corpus where it is present. */
export const assimpModels = process.env.TUTTE_MODELS ?? '/usr/share/assimp/models';
export const corpus = process.env.TUTTE_CORPUS ?? join(tests, '../../../shared/corpus');
/** What this test writes. */
export const scratch = join(build, 'web/scratch', basename(process.argv[1], '.mjs'));

/** Ends the program unless all of it is there. @param {string[]} needed */
export function need(...needed) {
  const missing = [tutte, installed, ...needed].filter((path) => !existsSync(path));
  if (missing.length > 0) {
    console.log(`skipped: run ./dev test, which makes ${missing.join(', ')}`);
    process.exit(77);
  }
  rmSync(scratch, {recursive: true, force: true});
  mkdirSync(scratch, {recursive: true});
}
