// A server for the browser's tests: a few folders under names of their own. Counts what is asked for.
import {readFile} from 'node:fs/promises';
import {createServer} from 'node:http';
import {extname, join, normalize} from 'node:path';

const types = {'.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm',
  '.json': 'application/json', '.css': 'text/css', '.svg': 'image/svg+xml', '.glb': 'model/gltf-binary', '.gltf': 'model/gltf+json', '.png': 'image/png'};

/**
 * @param {Record<string, string>} folders  name in URLs -> folder
 * @param {Map<string, Uint8Array | string>} files  URL path -> content, before the folders
 */
export async function serve(folders, files = new Map()) {
  /** @type {string[]} */
  const requests = [];
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
    requests.push(path);
    try {
      const [, name, ...rest] = path.split('/');
      const below = normalize(rest.join('/'));
      const known = files.get(path);
      if (known === undefined && (!(name in folders) || below.startsWith('..'))) throw new Error('not found');
      const body = known ?? await readFile(join(folders[name], below));
      response.writeHead(200, {'content-type': types[extname(path)] ?? 'application/octet-stream'}).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', () => done(undefined)));
  const {port} = /** @type {import('node:net').AddressInfo} */ (server.address());
  return {url: `http://127.0.0.1:${port}`, files, requests, close: () => server.close()};
}
