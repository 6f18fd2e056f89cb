"""Turns the triangles of an imported mesh back into its polygons, in place."""

import gc
from contextlib import contextmanager

import bmesh
import numpy as np

from . import report, rings, seams

_NORMALS = 'tutte_normal'


def give_polygons(mesh, source, join):
    """Replaces the triangles by the polygons of `source`, in their order. With `join`, the vertices that seams split
    become one. Materials, shape keys, weights and the values at corners stay. Raises ValueError when the mesh is not
    the one that the source describes."""
    if len(mesh.vertices) != source.vertex_count:
        raise ValueError('another add-on has changed its vertices')
    has_normals = mesh.has_custom_normals
    if has_normals:
        _keep_normals(mesh)
    with _editing(mesh) as work:
        _replace_faces(work, source, mesh.name)
        if join:
            _join_seams(work, source.clusters)
    if has_normals:
        _restore_normals(mesh)
    mesh.update()


@contextmanager
def _editing(mesh):
    """The mesh as one that can be edited; what was done to it goes into the mesh at the end."""
    collecting = gc.isenabled()
    gc.disable()  # there is nothing to collect among millions of small objects, and looking takes half of the time
    work = bmesh.new()
    try:
        work.from_mesh(mesh)
        yield work
        work.to_mesh(mesh)
    finally:
        work.free()
        if collecting:
            gc.enable()


def _keep_normals(mesh):
    """The normals at corners as values of their own, because Blender's custom normals do not outlive their faces."""
    if hasattr(mesh, 'calc_normals_split'):  # until Blender 4.0; later ones are always up to date
        mesh.calc_normals_split()
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    mesh.loops.foreach_get('normal', normals)
    mesh.attributes.new(_NORMALS, 'FLOAT_VECTOR', 'CORNER').data.foreach_set('vector', normals)


def _restore_normals(mesh):
    kept = mesh.attributes[_NORMALS]
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    kept.data.foreach_get('vector', normals)
    mesh.attributes.remove(kept)
    normals = normals.reshape(-1, 3)
    _set_smoothness(mesh, normals)
    mesh.normals_split_custom_set(normals)


def _set_smoothness(mesh, normals):
    """A face is flat whose corners all have its own normal, up to what quantisation does to it."""
    flat_enough = 0.99998  # cosine of a third of a degree
    count = len(mesh.polygons)
    starts = np.empty(count, dtype=np.int32)
    mesh.polygons.foreach_get('loop_start', starts)
    faces = np.empty(3 * count, dtype=np.float32)
    mesh.polygons.foreach_get('normal', faces)
    totals = np.diff(np.append(starts, len(normals)))
    cosines = np.sum(np.repeat(faces.reshape(-1, 3), totals, axis=0) * normals, axis=1)
    smooth = np.minimum.reduceat(cosines, starts) < flat_enough if count else np.empty(0, dtype=bool)
    mesh.polygons.foreach_set('use_smooth', smooth)


def _replace_faces(work, source, name):
    work.verts.ensure_lookup_table()
    work.faces.ensure_lookup_table()
    corners = {corner.vert.index: corner for face in work.faces for corner in face.loops}
    present = _present_triangles(work, source.triangles)
    obsolete = []
    left_out = 0
    for order, polygon in enumerate(source.polygons):
        triangles = [present[i] for i in range(polygon.begin, polygon.end) if i in present]
        faces, replaced = _faces_of(work, polygon.ring, triangles, corners)
        for face in faces:
            face.index = order
        obsolete.extend(replaced)
        left_out += not faces
    bmesh.ops.delete(work, geom=obsolete, context='FACES')
    work.faces.sort()
    if left_out:
        report.warn(f"The mesh '{name}' has {left_out} faces that Blender cannot hold: they visit a vertex twice, or "
                    'have the vertices of another face')


def _present_triangles(work, triangles):
    """The faces of the triangles, by number. Blender drops degenerate and double ones, but keeps the order."""
    present = {}
    number = 0
    for face in work.faces:
        corners = [vertex.index for vertex in face.verts]
        while number < len(triangles) and triangles[number] != corners:
            number += 1
        if number == len(triangles):
            raise ValueError('another add-on has changed its faces')
        present[number] = face
        number += 1
    return present


def _faces_of(work, ring, triangles, corners):
    """The faces that a polygon becomes, and the triangles that they replace."""
    if not rings.is_face(ring) or (len(ring) == 3 and triangles):
        return triangles, []
    face = _new_face(work, ring, triangles[0] if triangles else None, corners)
    return ([face], triangles) if face else (triangles, [])


def _new_face(work, ring, example, corners):
    """The polygon as a face, with what its triangles had at their corners; nothing where there is such a face."""
    vertices = [work.verts[i] for i in ring]
    try:
        face = work.faces.new(vertices, example) if example else work.faces.new(vertices)
    except ValueError:
        return None
    for corner in face.loops:
        if corner.vert.index in corners:
            corner.copy_from(corners[corner.vert.index])
    return face


def _join_seams(work, clusters):
    if len(work.verts) != len(clusters):
        raise ValueError('a triangle has a vertex that its polygon has not')
    work.verts.ensure_lookup_table()
    work.verts.index_update()
    faces = [[vertex.index for vertex in face.verts] for face in work.faces]
    roots = seams.joined(faces, list(zip(clusters, _values(work))))
    targets = {vertex: work.verts[root] for vertex, root in zip(work.verts, roots) if vertex.index != root}
    bmesh.ops.weld_verts(work, targetmap=targets)


def _values(work):
    """What a vertex is, but for its number: its places in all shape keys, and its weights."""
    shapes = work.verts.layers.shape.values()
    weights = work.verts.layers.deform.active
    return [(vertex.co[:], *(vertex[shape][:] for shape in shapes), *(vertex[weights].items() if weights else ()))
            for vertex in work.verts]
