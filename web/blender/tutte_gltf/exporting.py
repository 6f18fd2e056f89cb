"""Hook of Blender's own glTF exporter: adds the polygons as EXT_mesh_polygon, for `tutte encode` to find."""

import traceback
from contextlib import contextmanager

import numpy as np

from . import sharing

_current = None  # the export that is going on, when it is ours


class Export:
    """What the hook finds and does during one export."""

    def __init__(self):
        self.errors = []
        self.done = {}  # meshes that differ in materials only share what was made for the first of them


@contextmanager
def with_polygons():
    """Inside, the glTF exporter writes polygons too."""
    global _current
    _current = Export()
    try:
        yield _current
    finally:
        _current = None


class glTF2ExportUserExtension:  # the name that the exporter looks for
    """What the exporter calls, for every file."""

    def gather_mesh_hook(self, mesh, blender_mesh, *others):
        if _current is None:
            return
        try:
            _add_polygons(mesh, blender_mesh, others[-1], _current.done)
        except Exception as error:  # the exporter would swallow it
            traceback.print_exc()
            _current.errors.append(f"The polygons of '{blender_mesh.name}' cannot be written: {error}")


def _add_polygons(mesh, blender_mesh, export_settings, done):
    primitives = [p for p in mesh.primitives if p.mode is None or p.mode == 4]
    key = tuple(id(p.indices) for p in primitives)
    if key not in done:
        parts = _parts(blender_mesh, by_material=export_settings['gltf_materials'] != 'NONE')
        # The old accessors stay alive beside the new ones, so that no other gets their identity.
        done[key] = _converted(primitives, parts), [p.indices for p in primitives]
    for primitive, (vertices, indices, polygons) in zip(primitives, done[key][0]):
        # Not changed in place: the exporter's cache keeps the old ones, and may give them out again.
        primitive.attributes = vertices.attributes
        primitive.targets = vertices.targets
        primitive.indices = indices
        primitive.extensions = {**(primitive.extensions or {}), 'EXT_mesh_polygon': polygons}


def _converted(primitives, parts):
    """Per primitive its vertices, indices and polygons."""
    if len(parts) != len(primitives):
        raise ValueError('another add-on has changed its primitives')
    converted = []
    for primitive, vertices, part in zip(primitives, sharing.shared(primitives), parts):
        indices = _values(primitive.indices).astype(np.uint32) + np.uint32(vertices.base)
        converted.append((vertices, _accessor(indices, is_index=True), _polygons(indices, *part)))
    return converted


def _parts(mesh, by_material):
    """Per primitive, in the exporter's order: the corners of its triangles and its polygons, as ranges of corners."""
    count = len(mesh.loop_triangles)
    corners = np.empty(3 * count, dtype=np.int32)
    mesh.loop_triangles.foreach_get('loops', corners)
    owners = np.empty(count, dtype=np.int32)
    mesh.loop_triangles.foreach_get('polygon_index', owners)
    materials = np.zeros(count, dtype=np.int32)
    if by_material:
        mesh.loop_triangles.foreach_get('material_index', materials)
    corners = corners.reshape(-1, 3)
    return [(mesh, corners[materials == material], owners[materials == material]) for material in np.unique(materials)]


def _polygons(indices, mesh, corners, owners):
    """EXT_mesh_polygon of a primitive, from its triangles as vertices of the file and as corners of the mesh."""
    from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

    if indices.size != corners.size:
        raise ValueError('another add-on has changed its triangles')
    vertex_at = np.full(len(mesh.loops), -1, dtype=np.int64)
    vertex_at[corners.reshape(-1)] = indices
    begins = np.flatnonzero(np.diff(owners, prepend=-1))
    loops, offsets = [], []
    restart = np.iinfo(np.uint32).max
    for owner in owners[begins]:
        polygon = mesh.polygons[owner]
        ring = vertex_at[polygon.loop_start:polygon.loop_start + polygon.loop_total]
        if (ring < 0).any():
            raise ValueError("Blender's triangles leave out a corner of a face")
        loops.extend([restart] if loops else [])
        offsets.append(len(loops))
        loops.extend(ring.tolist())
    return Extension(name='EXT_mesh_polygon', required=False, extension={
        'count': len(offsets),
        'indicesOffsets': _accessor(3 * begins),
        'loopIndices': _accessor(loops),
        'loopIndicesOffsets': _accessor(offsets),
    })


def _values(accessor):
    from io_scene_gltf2.io.com.gltf2_io_constants import ComponentType

    return np.frombuffer(accessor.buffer_view.data, dtype=ComponentType.to_numpy_dtype(accessor.component_type))


def _accessor(values, is_index=False):
    from io_scene_gltf2.io.com.gltf2_io import Accessor
    from io_scene_gltf2.io.com.gltf2_io_constants import BufferViewTarget, ComponentType
    from io_scene_gltf2.io.exp.gltf2_io_binary_data import BinaryData

    data = np.asarray(values, dtype=np.uint32).tobytes()
    target = BufferViewTarget.ELEMENT_ARRAY_BUFFER if is_index else None
    return Accessor(buffer_view=BinaryData(data, target), byte_offset=None, component_type=ComponentType.UnsignedInt,
                    count=len(values), extensions=None, extras=None, max=None, min=None, name=None, normalized=None,
                    sparse=None, type='SCALAR')
