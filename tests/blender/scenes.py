"""Scenes made by rule, and what is compared of them."""
import math
import tempfile
from collections import Counter
from pathlib import Path

import bpy
from mathutils import Vector
from mathutils.kdtree import KDTree

STAR = [(2, 0, 0), (.5, .4, 0), (0, 2, 0), (-.5, .4, 0), (-2, 0, 0), (-.5, -.4, 0), (0, -2, 0), (.5, -.4, 0)]


def reset():
    """An empty scene; the add-ons and their preferences stay."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def add(name, vertices, faces, smooth=False):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set('use_smooth', [smooth] * len(faces))
    mesh.update()
    return link(name, mesh)


def link(name, mesh):
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_grid(name, size=6, smooth=True):
    points = [(x, y, math.sin(x) * math.cos(y)) for y in range(size) for x in range(size)]
    quads = [(i, i + 1, i + size + 1, i + size) for y in range(size - 1) for i in range(y * size, (y + 1) * size - 1)]
    return add(name, points, quads, smooth)


def add_drum(name, sides=24, smooth=False):
    """A prism: two n-gons and a ring of quads."""
    rim = [(math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides)) for i in range(sides)]
    around = [(i, (i + 1) % sides, (i + 1) % sides + sides, i + sides) for i in range(sides)]
    return add(name, [(x, y, z) for z in (0, 1) for x, y in rim],
               [tuple(reversed(range(sides))), *around, tuple(range(sides, 2 * sides))], smooth)


def add_star(name):
    """A concave polygon and a triangle at one of its edges."""
    return add(name, [*STAR, (2, 2, 0)], [tuple(range(8)), (1, 0, 8)])


def add_cubes(name, *corners):
    """Cubes in one mesh; ones that touch share no vertex."""
    vertices, faces = [], []
    for corner in corners:
        first = len(vertices)
        vertices += [Vector(corner) + Vector((x, y, z)) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        faces += [[first + i for i in face] for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3),
                                                         (0, 4, 6, 2), (1, 3, 7, 5))]
    return add(name, vertices, faces)


def add_uvs(thing):
    """Every face gets a part of the texture of its own: all its edges are seams."""
    layer = thing.data.uv_layers.new(name='UVMap')
    for face in thing.data.polygons:
        for i, corner in enumerate(face.loop_indices):
            angle = 2 * math.pi * i / face.loop_total
            layer.data[corner].uv = (.5 + .4 * math.cos(angle) + .01 * face.index, .5 + .4 * math.sin(angle))


def add_materials(thing, *names):
    for name in names:
        thing.data.materials.append(bpy.data.materials.new(name))
    for face in thing.data.polygons:
        face.material_index = face.index % len(names)


def export(path, **options):
    return bpy.ops.export_scene.tutte_gltf(filepath=str(path), **options)


def load(path, **options):
    reset()
    return bpy.ops.import_scene.gltf(filepath=str(path), **options)


def scratch():
    return Path(tempfile.mkdtemp(prefix='tutte-blender-'))


class Shape:
    """A mesh as it was, to compare with what it became."""

    def __init__(self, thing):
        mesh = thing.data
        self.points = [vertex.co.copy() for vertex in mesh.vertices]
        self.faces = [tuple(face.vertices) for face in mesh.polygons]
        self.materials = [mesh.materials[face.material_index].name if mesh.materials else None
                          for face in mesh.polygons]
        self.smooth = [face.use_smooth for face in mesh.polygons]
        mesh.calc_normals_split()
        self.normals = [mesh.loops[face.loop_start + i].normal.copy() for face in mesh.polygons
                        for i in range(face.loop_total)]
        self.uvs = [tuple(corner.uv) for corner in mesh.uv_layers[0].data] if mesh.uv_layers else None
        self.shapes = {key.name: [point.co.copy() for point in key.data] for key in mesh.shape_keys.key_blocks} \
            if mesh.shape_keys else {}
        self.weights = [{thing.vertex_groups[group.group].name: group.weight for group in vertex.groups}
                        for vertex in mesh.vertices]

    def vertices_in(self, other, tolerance):
        """Per vertex the one of `other` at its place."""
        tree = KDTree(len(other.points))
        for i, point in enumerate(other.points):
            tree.insert(point, i)
        tree.balance()
        found = [tree.find(point) for point in self.points]
        far = [distance for _, _, distance in found if distance > tolerance]
        assert not far, f'{len(far)} vertices are up to {max(far)} off'
        return [index for _, index, _ in found]

    def corners(self):
        """Per face and vertex where the values at that corner are."""
        at = iter(range(sum(map(len, self.faces))))
        return {(number, vertex): next(at) for number, face in enumerate(self.faces) for vertex in face}


def turned(face):
    """The face, beginning at its smallest vertex."""
    first = face.index(min(face))
    return face[first:] + face[:first]


def count_faces(faces):
    return Counter(map(turned, faces))
