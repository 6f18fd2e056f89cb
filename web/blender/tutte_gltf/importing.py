"""Hooks of Blender's own glTF importer: decode the file before, give its meshes their polygons back after."""

import os
import tempfile
import traceback

import numpy as np

from . import command, rebuild, report, rings, settings

EXTENSION = 'TUTTE_mesh_compression'
READ = (EXTENSION, 'FB_ngon_encoding', 'EXT_mesh_polygon')


class glTF2ImportUserExtension:  # the name that the importer looks for
    """What the importer calls, for every file."""

    def __init__(self):
        from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

        self.is_decoded = False
        self.extensions = [Extension(name=name, extension={}, required=True) for name in READ]

    def gather_import_gltf_before_hook(self, gltf):
        report.begin()
        _heal_numpy()
        self.is_decoded = EXTENSION in (gltf.data.extensions_used or []) and _decode(gltf)
        # Its own joining would hide which vertex is which; ours comes after.
        gltf.import_settings = {**gltf.import_settings, 'merge_vertices': False}

    def gather_import_mesh_after_hook(self, pymesh, mesh, gltf):
        if not any(_notations(primitive) for primitive in pymesh.primitives):
            return
        try:
            rebuild.give_polygons(mesh, _Source(gltf, pymesh, self.is_decoded), settings.join_vertices())
        except Exception as error:  # the importer would swallow it, and with it the reason
            traceback.print_exc()
            report.warn(f"The mesh '{mesh.name}' keeps its triangles: {error}")


def _heal_numpy():
    """Blender 3.4's importer uses a name that numpy 1.24, which Debian gives it, no longer has."""
    if 'bool' not in vars(np):
        np.bool = bool


def _decode(gltf):
    """Whether it was done. What prevented it is reported."""
    try:
        _adopt(gltf, _decoded(gltf.filename))
        return True
    except command.TutteError as error:
        if EXTENSION in (gltf.data.extensions_required or []):
            gltf.data = _Unreadable(f'Tutte: {error}')
        else:
            report.warn(f'The uncompressed copy inside the file was read instead. {error}')
        return False


class _Unreadable:
    """Stands where the importer looks for data next, outside the hook, and fails there in the way that it reports."""

    def __init__(self, reason):
        self.__dict__['reason'] = reason

    def __getattr__(self, name):
        from io_scene_gltf2.io.imp.gltf2_io_gltf import ImportError as ReportedError

        raise ReportedError(self.__dict__['reason'])


def _decoded(path):
    """The file as a plain GLB, as bytes."""
    with tempfile.TemporaryDirectory(prefix='tutte-') as folder:
        plain = os.path.join(folder, 'plain.glb')
        command.run(command.find(settings.command()), 'decode', path, plain)
        with open(plain, 'rb') as file:
            return file.read()


def _adopt(gltf, content):
    """The importer reads from `content` from now on, but for files beside the original."""
    from io_scene_gltf2.io.com.gltf2_io import gltf_from_dict

    json, gltf.glb_buffer = gltf.load_glb(memoryview(content))
    gltf.data = gltf_from_dict(json)
    gltf.buffers = {}


def _notations(primitive):
    return {'FB_ngon_encoding', 'EXT_mesh_polygon'}.intersection(primitive.extensions or {})


def _share_vertices(pymesh):
    return len({primitive.attributes.get('POSITION') for primitive in pymesh.primitives}) == 1


class _Source:
    """The triangles and polygons of a glTF mesh, over the vertices that the importer made: each primitive's used ones,
    in order. Vertices of different `clusters` were never one."""

    def __init__(self, gltf, pymesh, is_decoded):
        self.gltf = gltf
        self.clusters = []
        self.triangles = []
        self.polygons = []
        self.vertex_count = 0
        for primitive in pymesh.primitives:
            if 'POSITION' in primitive.attributes:
                self._add(primitive, is_decoded and _share_vertices(pymesh))

    def _add(self, primitive, in_clusters):
        from io_scene_gltf2.blender.imp.gltf2_blender_mesh import points_edges_tris

        mode = 4 if primitive.mode is None else primitive.mode
        points, edges, triangles = points_edges_tris(mode, self._indices(primitive))
        used = np.unique(next(part for part in (points, edges, triangles) if part is not None))
        if triangles is not None:
            self._add_faces(primitive, triangles.reshape(-1, 3), used)
        self.vertex_count += len(used)
        self.clusters.extend(self._clusters(primitive)[used].tolist() if in_clusters else [0] * len(used))

    def _clusters(self, primitive):
        """Per vertex of the file a number. The decoder lists the copies of a vertex one after the other, so that those
        of another, which quantisation moved to the same place, can be told from them."""
        positions = self._read(primitive.attributes['POSITION']).reshape(-1, 3)
        return np.cumsum((positions != np.roll(positions, 1, axis=0)).any(axis=1))

    def _add_faces(self, primitive, triangles, used):
        vertex_of = np.zeros(int(used[-1]) + 1 if len(used) else 0, dtype=np.int64)
        vertex_of[used] = np.arange(len(used)) + self.vertex_count
        numbers = vertex_of.tolist()
        for polygon in self._polygons(primitive, triangles):
            polygon.ring = [numbers[wedge] for wedge in polygon.ring]
            polygon.begin += len(self.triangles)
            polygon.end += len(self.triangles)
            self.polygons.append(polygon)
        self.triangles.extend(vertex_of[triangles].tolist())

    def _indices(self, primitive):
        if primitive.indices is None:
            return np.arange(self.gltf.data.accessors[primitive.attributes['POSITION']].count, dtype=np.uint32)
        return self._read(primitive.indices)

    def _polygons(self, primitive, triangles):
        notations = _notations(primitive)
        if 'EXT_mesh_polygon' in notations:
            arrays = primitive.extensions['EXT_mesh_polygon']
            loops = self._read(arrays['loopIndices'])
            return rings.of_loops(triangles, loops, self._read(arrays['loopIndicesOffsets']),
                                  self._read(arrays['indicesOffsets']), restart=np.iinfo(loops.dtype).max)
        return rings.of_fans(triangles) if notations else rings.of_triangles(triangles)

    def _read(self, accessor):
        from io_scene_gltf2.io.imp.gltf2_io_binary import BinaryData

        return BinaryData.decode_accessor(self.gltf, accessor).reshape(-1)
