// The two extensions that say what a primitive's polygons are, for glTF-Transform, which knows neither.

import {Extension, ExtensionProperty, PropertyType} from '@gltf-transform/core';

/** Its properties are set by init(), before fields could be; the types do not know that. @type {new (...args: any[]) => any} */
const Property = /** @type {any} */ (ExtensionProperty);

/** A primitive's mark that its triangles are fans of polygons. */
export class NgonMark extends Property {
  static EXTENSION_NAME = 'FB_ngon_encoding';
  init() {
    this.extensionName = 'FB_ngon_encoding';
    this.propertyType = 'NgonMark';
    this.parentTypes = [PropertyType.PRIMITIVE];
  }
}

/** FB_ngon_encoding: without it, glTF-Transform drops the marks. */
export class FBNgonEncoding extends Extension {
  static EXTENSION_NAME = 'FB_ngon_encoding';
  extensionName = 'FB_ngon_encoding';

  createNgonMark() {
    return new NgonMark(this.document.getGraph());
  }

  /** @param {any} context */
  read(context) {
    forEachPrimitive(context, this.extensionName, (primitive) => {
      primitive.setExtension(this.extensionName, this.createNgonMark());
    });
    return this;
  }

  /** @param {any} context */
  write(context) {
    forEachWritten(this.document, context, this.extensionName, () => ({}));
    return this;
  }
}

const polygonArrays = ['indicesOffsets', 'loopIndices', 'loopIndicesOffsets'];

/** A primitive's polygons. */
export class MeshPolygon extends Property {
  static EXTENSION_NAME = 'EXT_mesh_polygon';
  init() {
    this.extensionName = 'EXT_mesh_polygon';
    this.propertyType = 'MeshPolygon';
    this.parentTypes = [PropertyType.PRIMITIVE];
  }

  getDefaults() {
    return Object.assign(super.getDefaults(), {
      count: 0, indicesOffsets: null, loopIndices: null, loopIndicesOffsets: null,
    });
  }

  getCount() {
    return this.get('count');
  }

  /** @param {number} count */
  setCount(count) {
    return this.set('count', count);
  }

  /** @param {'indicesOffsets' | 'loopIndices' | 'loopIndicesOffsets'} name */
  getArray(name) {
    return this.getRef(name);
  }

  /** @param {'indicesOffsets' | 'loopIndices' | 'loopIndicesOffsets'} name @param {any} accessor */
  setArray(name, accessor) {
    return this.setRef(name, accessor, {usage: 'OTHER'});
  }
}

/** EXT_mesh_polygon: without it, glTF-Transform drops the polygons. */
export class EXTMeshPolygon extends Extension {
  static EXTENSION_NAME = 'EXT_mesh_polygon';
  extensionName = 'EXT_mesh_polygon';

  createMeshPolygon() {
    return new MeshPolygon(this.document.getGraph());
  }

  /** @param {any} context */
  read(context) {
    forEachPrimitive(context, this.extensionName, (primitive, definition) => {
      const polygons = this.createMeshPolygon();
      polygons.setCount(definition.count ?? 0);
      for (const name of polygonArrays) {
        if (definition[name] !== undefined) polygons.setArray(/** @type {any} */ (name), context.accessors[definition[name]]);
      }
      primitive.setExtension(this.extensionName, polygons);
    });
    return this;
  }

  /** @param {any} context */
  write(context) {
    forEachWritten(this.document, context, this.extensionName, (polygons) => {
      /** @type {any} */
      const definition = {count: polygons.getCount()};
      for (const name of polygonArrays) {
        const accessor = polygons.getArray(name);
        if (accessor) definition[name] = context.accessorIndexMap.get(accessor);
      }
      return definition;
    });
    return this;
  }
}

/**
 * @param {any} context @param {string} extension
 * @param {(primitive: any, definition: any) => void} visit
 */
function forEachPrimitive(context, extension, visit) {
  context.jsonDoc.json.meshes?.forEach((/** @type {any} */ mesh, /** @type {number} */ m) => {
    mesh.primitives.forEach((/** @type {any} */ primitive, /** @type {number} */ p) => {
      const definition = primitive.extensions?.[extension];
      if (definition) visit(context.meshes[m].listPrimitives()[p], definition);
    });
  });
}

/**
 * @param {any} document @param {any} context @param {string} extension
 * @param {(property: any) => any} define
 */
function forEachWritten(document, context, extension, define) {
  for (const mesh of document.getRoot().listMeshes()) {
    const definition = context.jsonDoc.json.meshes[context.meshIndexMap.get(mesh)];
    mesh.listPrimitives().forEach((/** @type {any} */ primitive, /** @type {number} */ p) => {
      const property = primitive.getExtension(extension);
      if (!property) return;
      definition.primitives[p].extensions ??= {};
      definition.primitives[p].extensions[extension] = define(property);
    });
  }
}
