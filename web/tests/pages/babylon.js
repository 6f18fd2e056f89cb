// What the tests ask of Babylon.js: to load a file and draw it.
import {loadTutte} from 'tutte-gltf';
import {registerTutte} from 'tutte-gltf/babylon';

const {BABYLON} = globalThis;
const canvas = document.getElementById('canvas');
const engine = new BABYLON.Engine(canvas, false, {preserveDrawingBuffer: true});
const decoders = {pool: loadTutte({workers: 2}), local: loadTutte({workers: 0})};

function choose(decoder) {
  const {registerGLTFExtension, unregisterGLTFExtension} = BABYLON.GLTF2;
  unregisterGLTFExtension('TUTTE_mesh_compression');
  if (decoder) registerTutte(registerGLTFExtension, decoders[decoder]);
}

async function draw(scene) {
  scene.clearColor = new BABYLON.Color4(0.1, 0.2, 0.3, 1);
  const {min, max} = scene.getWorldExtends((mesh) => mesh.getTotalVertices() > 0);
  const centre = min.add(max).scale(0.5), radius = max.subtract(min).length() / 2;
  const camera = new BABYLON.ArcRotateCamera('camera', 0.9, 1.1, 2.6 * radius, centre, scene);
  camera.minZ = radius / 100;
  camera.maxZ = radius * 10;
  new BABYLON.HemisphericLight('light', new BABYLON.Vector3(0.3, 1, 0.2), scene).intensity = 1.5;
  for (const material of scene.materials) material.metallic = 0;  // without surroundings, metal is black
  await scene.whenReadyAsync();
  scene.render();
  const pixels = await engine.readPixels(0, 0, canvas.width, canvas.height);
  return Array.from(pixels);
}

/** Loads and draws a file. Gives the picture, or the loader's error. */
globalThis.show = async (url, decoder) => {
  choose(decoder);
  const scene = new BABYLON.Scene(engine);
  try {
    await BABYLON.SceneLoader.AppendAsync('', url, scene);
    return {picture: await draw(scene)};
  } catch (error) {
    return {error: String(error)};
  } finally {
    scene.dispose();
  }
};

/** Bytes in use after loading a file `times` times. */
globalThis.loadMany = async (url, decoder, times) => {
  choose(decoder);
  for (let i = 0; i < times; ++i) {
    const scene = new BABYLON.Scene(engine);
    await BABYLON.SceneLoader.AppendAsync('', url, scene);
    scene.dispose();
  }
  globalThis.gc?.();
  await new Promise((done) => setTimeout(done, 50));
  globalThis.gc?.();
  return performance.memory.usedJSHeapSize;
};

globalThis.ready = true;
