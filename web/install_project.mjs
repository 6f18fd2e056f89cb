// Installs the packed package into an empty project, without a registry: it has no dependencies.
//
//   node install_project.mjs FOLDER     with FOLDER/tutte-gltf.tgz; makes FOLDER/project
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync, writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';

const folder = resolve(process.argv[2]), project = join(folder, 'project');
rmSync(project, {recursive: true, force: true});
mkdirSync(project, {recursive: true});
writeFileSync(join(project, 'package.json'), JSON.stringify({name: 'empty', private: true, type: 'module'}));
execFileSync('npm', ['install', '--offline', '--no-audit', '--no-fund', '--loglevel=error', '--legacy-peer-deps',
  join(folder, 'tutte-gltf.tgz')], {cwd: project, stdio: 'inherit'});
