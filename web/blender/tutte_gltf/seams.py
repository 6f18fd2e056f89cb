"""Joins the vertices that glTF had to split where texture coordinates or normals jump. Nothing here knows Blender.

Only vertices are joined whose edges say so: two faces with open edges at one place, which are then one edge. Parts that
merely touch stay apart.
"""

from collections import defaultdict


def joined(faces, values):
    """Per vertex the vertex that it becomes.

    `faces` are lists of vertices; only vertices with equal `values` (anything hashable) may become one.
    """
    numbers = {}
    places = [numbers.setdefault(value, len(numbers)) for value in values]
    frozen = set()
    while True:
        roots = _join(faces, places, frozen)
        broken = {vertex for face in _broken_faces(faces, roots) for vertex in face} - frozen
        if not broken:
            return roots
        frozen |= broken


def _join(faces, places, frozen):
    roots = list(range(len(places)))

    def root(vertex):
        while roots[vertex] != vertex:
            roots[vertex] = roots[roots[vertex]]
            vertex = roots[vertex]
        return vertex

    for sides in _edges_by_place(faces, places).values():
        copies = [edge for edge in set(sides) if frozen.isdisjoint(edge)]
        # An even number of faces above two are several edges that touch.
        if len(copies) < 2 or (len(sides) > 2 and len(sides) % 2 == 0):
            continue
        first, *others = copies
        for other in others:
            for a, b in zip(first, other):
                a, b = root(a), root(b)
                roots[max(a, b)] = min(a, b)
    return [root(vertex) for vertex in range(len(places))]


def _edges_by_place(faces, places):
    """The edges of all faces by the places of their ends; edges without length are left out."""
    edges = defaultdict(list)
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            if places[a] > places[b]:
                a, b = b, a
            if places[a] != places[b]:
                edges[places[a], places[b]].append((a, b))
    return edges


def _broken_faces(faces, roots):
    """The faces that would lose a corner, or become equal to another face."""
    by_corners = defaultdict(list)
    for face in faces:
        by_corners[frozenset(roots[vertex] for vertex in face)].append(face)
    return [face for corners, same in by_corners.items() for face in same
            if len(same) > 1 or len(corners) < len(face)]
