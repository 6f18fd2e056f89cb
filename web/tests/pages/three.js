// What the tests ask of three.js: to load a file and draw it.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {loadTutte} from 'tutte-gltf';
import {polygonLines, TutteMeshCompression} from 'tutte-gltf/three';

const canvas = document.getElementById('canvas');
const renderer = new THREE.WebGLRenderer({canvas, antialias: false, preserveDrawingBuffer: true});
const decoders = {pool: loadTutte({workers: 2}), local: loadTutte({workers: 0})};

function load(url, decoder) {
  const loader = new GLTFLoader();
  if (decoder) loader.register((parser) => new TutteMeshCompression(parser, decoders[decoder]));
  return loader.loadAsync(url);
}

function meshesOf(scene) {
  const meshes = [];
  scene.traverse((object) => object.isMesh && meshes.push(object));
  return meshes;
}

async function addEdges(gltf) {
  const material = new THREE.LineBasicMaterial({color: 0xffff00});
  let edges = 0;
  for (const mesh of meshesOf(gltf.scene)) {
    const lines = await polygonLines(gltf, mesh, material);
    edges += lines.geometry.index.count / 2;
    mesh.add(lines);
  }
  return edges;
}

/** What glTF calls metal is black without surroundings to reflect. */
function lighten(root) {
  for (const mesh of meshesOf(root)) for (const material of [mesh.material].flat()) material.metalness = 0;
}

function draw(root) {
  lighten(root);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x203040);
  scene.add(root, new THREE.HemisphereLight(0xffffff, 0x404040, 3));
  const box = new THREE.Box3().setFromObject(root), sphere = box.getBoundingSphere(new THREE.Sphere());
  const camera = new THREE.PerspectiveCamera(40, 4 / 3, sphere.radius / 100, sphere.radius * 10);
  camera.position.copy(sphere.center).addScaledVector(new THREE.Vector3(0.6, 0.5, 1).normalize(), 3 * sphere.radius);
  camera.lookAt(sphere.center);
  renderer.render(scene, camera);
  const {width, height} = canvas, pixels = new Uint8Array(4 * width * height), gl = renderer.getContext();
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return Array.from(pixels);
}

function dispose(gltf) {
  for (const mesh of meshesOf(gltf.scene)) {
    mesh.geometry.dispose();
    for (const material of [mesh.material].flat()) material.dispose();
  }
}

/** Loads and draws a file. Gives the picture and the number of polygon edges, or the loader's error. */
globalThis.show = async (url, decoder, withEdges = false) => {
  try {
    const gltf = await load(url, decoder);
    const edges = withEdges ? await addEdges(gltf) : 0;
    const picture = draw(gltf.scene);
    dispose(gltf);
    return {picture, edges};
  } catch (error) {
    return {error: String(error), code: error.code};
  }
};

/** Bytes in use after loading a file `times` times. */
globalThis.loadMany = async (url, decoder, times) => {
  for (let i = 0; i < times; ++i) dispose(await load(url, decoder));
  globalThis.gc?.();
  await new Promise((done) => setTimeout(done, 50));
  globalThis.gc?.();
  return performance.memory.usedJSHeapSize;
};

globalThis.ready = true;
