import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {RoomEnvironment} from 'three/addons/environments/RoomEnvironment.js';
import {toCreasedNormals} from 'three/addons/utils/BufferGeometryUtils.js';
import {loadPolygons, polygonEdges} from 'tutte-gltf/three';

const turnStep = Math.PI / 24,
  zoomStep = 1.15;

/** The picture: one model, its polygon edges, and a camera that keys turn too. */
export class Stage {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.scene = new THREE.Scene();
    this.scene.environment = new THREE.PMREMGenerator(this.renderer).fromScene(new RoomEnvironment(), 0.03).texture;
    this.scene.environmentIntensity = 0.55;
    this.sun = new THREE.DirectionalLight(0xffffff, 1.8);
    this.scene.add(this.sun);
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    // Dark lines for light surfaces, light ones for dark.
    this.ink = new THREE.LineBasicMaterial({transparent: true});
    this.chalk = new THREE.LineBasicMaterial({transparent: true});
    this.clay = new THREE.MeshStandardMaterial({roughness: 0.62, side: THREE.DoubleSide});
    /** @type {THREE.Object3D | null} */
    this.model = null;
    this.edgesShown = true;
    this.pending = false;
    canvas.addEventListener('keydown', (event) => this.#key(event));
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
    this.recolor();
  }

  /** Takes the theme's colours from the style sheet. */
  recolor() {
    const style = getComputedStyle(this.canvas);
    for (const name of ['ink', 'chalk', 'clay']) this[name].color.set(style.getPropertyValue(`--${name}`).trim());
    this.model?.traverse((/** @type {any} */ part) => {
      if (part.isLineSegments) part.material = this.#lineOn(part.parent);
    });
    this.draw();
  }

  /**
   * Shows a loaded model instead of the one before. The camera stays when `keepView` is set.
   * @param {any} gltf  @param {boolean} keepView
   * @returns {Promise<{degrees: Map<number, number>, vertices: number}>}  how many faces have how many corners, and
   *     vertices as glTF counts them
   */
  async show(gltf, keepView) {
    const model = gltf.scene ?? gltf.scenes[0];
    model.updateMatrixWorld(true);
    const degrees = new Map(),
      meshes = [];
    let edgeCount = 0,
      vertices = 0;
    model.traverse((part) => {
      if (part.isMesh) meshes.push(part);
    });
    for (const mesh of meshes) {
      const {starts} = await loadPolygons(gltf, mesh);
      for (let i = 0; i + 1 < starts.length; ++i) {
        const degree = starts[i + 1] - starts[i];
        degrees.set(degree, (degrees.get(degree) ?? 0) + 1);
      }
      const geometry = await this.#edgesOf(gltf, mesh);
      vertices += mesh.geometry.attributes.position.count;
      edgeCount += geometry.index.count / 2;
      this.#dress(mesh);
      mesh.add(new THREE.LineSegments(geometry, this.#lineOn(mesh)));
    }
    this.#replace(model);
    this.ink.opacity = this.chalk.opacity = Math.min(0.9, Math.max(0.22, 60 / Math.sqrt(edgeCount + 1)));
    if (!keepView) this.reset();
    this.draw();
    return {degrees, vertices};
  }

  /** The edges of a mesh's polygons, at its vertices as bones and morph targets have them. */
  async #edgesOf(gltf, mesh) {
    const edges = await polygonEdges(gltf, mesh);
    const geometry = new THREE.BufferGeometry().setIndex(edges.index);
    const plain = mesh.geometry.attributes.position;
    let position = plain;
    if (mesh.isSkinnedMesh || mesh.morphTargetInfluences?.some(Boolean)) {
      position = new THREE.BufferAttribute(new Float32Array(3 * plain.count), 3);
      const point = new THREE.Vector3();
      for (let i = 0; i < plain.count; ++i) position.setXYZ(i, ...mesh.getVertexPosition(i, point).toArray());
    }
    return geometry.setAttribute('position', position);
  }

  /** @param {any} mesh */
  #lineOn({material}) {
    const {color, map} = [material].flat()[0];
    const lightness = color ? (0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b) * (map ? 0.5 : 1) : 0.5;
    return lightness > 0.2 ? this.ink : this.chalk;
  }

  /** A look for meshes without one. @param {any} mesh */
  #dress(mesh) {
    mesh.frustumCulled = false;
    if (!mesh.geometry.attributes.normal && !mesh.isSkinnedMesh && !mesh.geometry.morphAttributes.position) {
      mesh.geometry = toCreasedNormals(mesh.geometry, Math.PI / 5);
    }
    const {color, map, vertexColors} = mesh.material;
    if (color?.getHex() === 0xffffff && !map && !vertexColors) mesh.material = this.clay;
    for (const material of [mesh.material].flat()) {
      Object.assign(material, {polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    }
  }

  /** @param {THREE.Object3D} model */
  #replace(model) {
    if (this.model) {
      this.scene.remove(this.model);
      this.model.traverse((/** @type {any} */ part) => {
        part.geometry?.dispose();
        for (const material of [part.material ?? []].flat()) {
          if (![this.ink, this.chalk, this.clay].includes(material)) material.dispose();
        }
      });
    }
    this.model = model;
    this.scene.add(model);
    this.showEdges(this.edgesShown);
  }

  /** @param {boolean} shown */
  showEdges(shown) {
    this.edgesShown = shown;
    this.ink.visible = this.chalk.visible = shown;
    this.draw();
  }

  /** The whole model, from the front and a little above. */
  reset() {
    if (!this.model) return;
    const {center, radius} = boundsOf(this.model);
    const half = Math.atan(Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2)) * Math.min(1, this.camera.aspect));
    const direction = new THREE.Vector3(0.55, 0.38, 1).normalize();
    this.camera.position.copy(center).addScaledVector(direction, (1.06 * radius) / Math.sin(half));
    this.camera.near = radius / 100;
    this.camera.far = radius * 100;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(center);
    this.controls.update();
    this.draw();
  }

  /** Whether the model turns by itself. @param {boolean} on */
  turn(on) {
    this.controls.autoRotate = on;
    this.draw();
  }

  /** Draws soon, once, however often it is called. */
  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      if (this.controls.autoRotate) this.controls.update();
      this.sun.position.copy(this.camera.position).applyAxisAngle(new THREE.Vector3(0.4, 1, 0).normalize(), 0.75);
      this.renderer.render(this.scene, this.camera);
      if (this.controls.autoRotate) this.draw();
    });
  }

  #resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in steps) this.#orbit(...steps[event.key]);
    else if (event.key === '+' || event.key === '=') this.#zoom(1 / zoomStep);
    else if (event.key === '-') this.#zoom(zoomStep);
    else if (event.key === '0' || event.key === 'Home') this.reset();
    else return;
    event.preventDefault();
  }

  /** @param {number} right @param {number} down */
  #orbit(right, down) {
    const place = this.camera.position.clone().sub(this.controls.target);
    const spherical = new THREE.Spherical().setFromVector3(place);
    spherical.theta -= right * turnStep;
    spherical.phi += down * turnStep;
    this.camera.position.setFromSpherical(spherical.makeSafe()).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  /** @param {number} factor */
  #zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.draw();
  }
}

/** A sphere around all vertices, as bones and morph targets have them. @param {THREE.Object3D} model */
function boundsOf(model) {
  const center = new THREE.Box3().setFromObject(model, true).getCenter(new THREE.Vector3());
  const point = new THREE.Vector3();
  let radius = 0;
  model.traverse((/** @type {any} */ part) => {
    if (!part.isMesh) return;
    for (let i = 0; i < part.geometry.attributes.position.count; ++i) {
      part.getVertexPosition(i, point).applyMatrix4(part.matrixWorld);
      radius = Math.max(radius, point.distanceTo(center));
    }
  });
  return {center, radius: radius || 1};
}
