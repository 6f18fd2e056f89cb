// What the tests ask of PlayCanvas: to load a file and draw it.
import * as pc from 'playcanvas';
import {loadTutte} from 'tutte-gltf';
import {tutteContainerOptions} from 'tutte-gltf/playcanvas';

const canvas = document.getElementById('canvas');
const app = new pc.Application(canvas, {graphicsDeviceOptions: {preserveDrawingBuffer: true, antialias: false}});
app.autoRender = false;
app.scene.ambientLight = new pc.Color(0.3, 0.3, 0.3);
app.start();
const camera = new pc.Entity('camera'), light = new pc.Entity('light');
camera.addComponent('camera', {clearColor: new pc.Color(0.1, 0.2, 0.3)});
light.addComponent('light', {type: 'directional', intensity: 1.5});
light.setEulerAngles(40, 30, 0);
app.root.addChild(camera);
app.root.addChild(light);
const decoders = {pool: loadTutte({workers: 2}), local: loadTutte({workers: 0})};
let number = 0;

function load(url, decoder) {
  const options = decoder ? tutteContainerOptions(decoders[decoder]) : {};
  const asset = new pc.Asset(`file ${number++}`, 'container', {url}, null, options);
  return new Promise((done, fail) => {
    asset.once('load', () => done(asset));
    asset.once('error', (error) => fail(new Error(String(error))));
    app.assets.add(asset);
    app.assets.load(asset);
  });
}

function boundsOf(entity) {
  const bounds = new pc.BoundingBox();
  let first = true;
  for (const render of entity.findComponents('render')) {
    for (const {aabb} of render.meshInstances) {
      if (first) bounds.copy(aabb);
      else bounds.add(aabb);
      first = false;
    }
  }
  return bounds;
}

function draw(entity) {
  app.root.addChild(entity);
  app.root.syncHierarchy();
  const bounds = boundsOf(entity), radius = bounds.halfExtents.length();
  camera.camera.nearClip = radius / 100;
  camera.camera.farClip = radius * 10;
  camera.setPosition(bounds.center.clone().add(new pc.Vec3(0.6, 0.5, 1).normalize().mulScalar(2.6 * radius)));
  camera.lookAt(bounds.center);
  app.update(0);
  app.render();
  const {width, height} = canvas, pixels = new Uint8Array(4 * width * height), {gl} = app.graphicsDevice;
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return Array.from(pixels);
}

function unload(asset) {
  asset.unload();
  app.assets.remove(asset);
}

/** Loads and draws a file. Gives the picture, or the loader's error. */
globalThis.show = async (url, decoder) => {
  try {
    const asset = await load(url, decoder);
    const entity = asset.resource.instantiateRenderEntity();
    const picture = draw(entity);
    entity.destroy();
    unload(asset);
    return {picture};
  } catch (error) {
    return {error: String(error)};
  }
};

/** Bytes in use after loading a file `times` times. */
globalThis.loadMany = async (url, decoder, times) => {
  for (let i = 0; i < times; ++i) unload(await load(url, decoder));
  globalThis.gc?.();
  await new Promise((done) => setTimeout(done, 50));
  globalThis.gc?.();
  return performance.memory.usedJSHeapSize;
};

globalThis.ready = true;
