// One mesh in the forms that the contenders decode: made by their own encoders, of the same decoded file, at equal
// quantisation (14 bits for positions, 10 for normals, 12 for texture coordinates).
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {basename, join} from 'node:path';

import {readGlb} from '../tests/glb.mjs';
import {installed, npm, scratch, tutte} from '../tests/places.mjs';

const require = createRequire(join(npm, 'x.js'));
const {compressedView} = await import(join(installed, 'src/gltf.js'));
const components = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4};
const bits = {POSITION: 14, NORMAL: 10, TEXCOORD_0: 12};

/** An accessor's numbers, without gaps. */
function numbersOf({json, bin}, index) {
  const accessor = json.accessors[index], view = json.bufferViews[accessor.bufferView], width = components[accessor.type];
  const Type = {5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array}[accessor.componentType];
  const size = Type.BYTES_PER_ELEMENT, stride = view.byteStride ?? width * size;
  const start = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
  const source = new Type(bin.slice(start, start + accessor.count * stride).buffer);
  const values = new Type(accessor.count * width);
  for (let i = 0; i < accessor.count; ++i) {
    for (let c = 0; c < width; ++c) values[i * width + c] = source[i * stride / size + c];
  }
  return {values, width, count: accessor.count};
}

/** The model as we compress it, in a profile or what the command chooses, and what our decoder is to give. */
function tutteInput(source, profile) {
  const file = join(scratch, 'bench.glb'), plain = join(scratch, 'bench.plain.glb');
  const choice = profile ? ['--profile', profile] : [];
  execFileSync(tutte, ['encode', source, file, '--attributes', Object.keys(bits).join(','), ...choice], {stdio: 'ignore'});
  execFileSync(tutte, ['decode', file, plain], {stdio: 'ignore'});
  const {json, bin} = readGlb(new Uint8Array(readFileSync(file)));
  const views = json.bufferViews.map((_, index) => ({index, view: compressedView(json, index)})).filter(({view}) => view);
  const {byteOffset, byteLength} = views.reduce((a, b) => (b.view.byteLength > a.view.byteLength ? b : a)).view;
  const members = views.filter(({view}) => view.byteOffset === byteOffset);
  return {
    payload: bin.slice(byteOffset, byteOffset + byteLength),
    requests: members.map(({view}) => view),
    indices: members.map(({index}) => index),
    plain: readGlb(new Uint8Array(readFileSync(plain))),
  };
}

/** The mesh that the payload holds: the primitives that use its views. */
function meshOf({plain, indices: views}) {
  const viewOf = (accessor) => plain.json.accessors[accessor].bufferView;
  const parts = plain.json.meshes.flatMap((mesh) => mesh.primitives).filter((one) => views.includes(viewOf(one.indices)));
  const attributes = Object.entries(parts[0].attributes).filter(([name]) => name in bits)
    .map(([name, accessor]) => ({name, ...numbersOf(plain, accessor)}));
  return {indices: Uint32Array.from(parts.flatMap((one) => Array.from(numbersOf(plain, one.indices).values))), attributes};
}

/** Draco's bytes at compression level 10 (speed 0) and 7 (speed 3). */
async function dracoInput({indices, attributes}, speed) {
  const draco = await require('draco3d').createEncoderModule({});
  const builder = new draco.MeshBuilder(), mesh = new draco.Mesh(), encoder = new draco.Encoder();
  builder.AddFacesToMesh(mesh, indices.length / 3, indices);
  const types = {POSITION: draco.POSITION, NORMAL: draco.NORMAL, TEXCOORD_0: draco.TEX_COORD};
  const described = attributes.map(({name, values, width, count}) => {
    encoder.SetAttributeQuantization(types[name], bits[name]);
    return {name, components: width, id: builder.AddFloatAttribute(mesh, types[name], count, width, Float32Array.from(values))};
  });
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetEncodingMethod(draco.MESH_EDGEBREAKER_ENCODING);
  const out = new draco.DracoInt8Array(), length = encoder.EncodeMeshToDracoBuffer(mesh, out);
  const bytes = Uint8Array.from({length}, (_, i) => out.GetValue(i));
  [out, encoder, builder, mesh].forEach((object) => draco.destroy(object));
  return {bytes, attributes: described};
}

/** EXT_meshopt_compression's streams: quantised to 16-bit integers, reordered for it as gltfpack does. */
async function meshoptInput({indices, attributes}) {
  const {MeshoptEncoder} = await import(join(npm, 'meshoptimizer/index.js'));
  await MeshoptEncoder.ready;
  const order = indices.slice(), [remap, count] = MeshoptEncoder.reorderMesh(order, true, false);
  const streams = [{mode: 'TRIANGLES', count: order.length, stride: 4,
    bytes: MeshoptEncoder.encodeGltfBuffer(new Uint8Array(order.buffer), order.length, 4, 'TRIANGLES')}];
  for (const {name, values, width} of attributes) {
    const stride = width * 2 + (width * 2) % 4, quantised = new Int16Array(count * stride / 2);
    const [least, most] = extremes(values);
    const scale = ((1 << bits[name]) - 1) / (most - least || 1);
    for (let i = 0; i < remap.length; ++i) {
      if (remap[i] === 0xFFFFFFFF) continue;
      for (let c = 0; c < width; ++c) quantised[remap[i] * stride / 2 + c] = Math.round((values[i * width + c] - least) * scale);
    }
    streams.push({mode: 'ATTRIBUTES', count, stride,
      bytes: MeshoptEncoder.encodeGltfBuffer(new Uint8Array(quantised.buffer), count, stride, 'ATTRIBUTES')});
  }
  return streams;
}

function extremes(values) {
  let least = Infinity, most = -Infinity;
  for (const value of values) {
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  return [least, most];
}

/** Everything that the contenders need of one model; our profile is one's choice. */
export async function inputsOf(source, profile) {
  const own = tutteInput(source, profile), mesh = meshOf(own), {json, bin} = own.plain;
  return {
    name: basename(source),
    triangles: mesh.indices.length / 3,
    tutte: {payload: own.payload, requests: own.requests},
    // What the native decoder gives, to be compared.
    expected: own.indices.map((index) => {
      const {byteOffset = 0, byteLength} = json.bufferViews[index];
      return bin.slice(byteOffset, byteOffset + byteLength);
    }),
    draco10: await dracoInput(mesh, 0),
    draco7: await dracoInput(mesh, 3),
    meshopt: await meshoptInput(mesh),
  };
}
