"""The polygons of a glTF primitive, from its triangles and one of the two notations. Nothing here knows Blender."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Polygon:
    """A face: its corners, counter-clockwise, and its triangles, triangles[begin:end] of the primitive."""

    ring: list
    begin: int
    end: int


def of_triangles(triangles):
    """Every triangle a polygon. `triangles` has the shape (count, 3), here and below."""
    return [Polygon(list(corners), i, i + 1) for i, corners in enumerate(triangles.tolist())]


def of_fans(triangles):
    """FB_ngon_encoding: triangles in a row that start at one vertex, each where the last one ended, are a polygon."""
    polygons = []
    last = None
    for i, (a, b, c) in enumerate(triangles.tolist()):
        if last and last.ring[0] == a and last.ring[-1] == b:
            last.ring.append(c)
            last.end = i + 1
        else:
            last = Polygon([a, b, c], i, i + 1)
            polygons.append(last)
    return polygons


def of_loops(triangles, loops, loop_offsets, index_offsets, restart):
    """EXT_mesh_polygon. Polygons with holes, which Blender does not know, stay triangles. Raises ValueError."""
    begins = np.append(index_offsets, 3 * len(triangles)).astype(np.int64)
    starts = np.append(loop_offsets, len(loops)).astype(np.int64)
    if len(begins) != len(starts) or begins[0] != 0 or (np.diff(begins) < 0).any() or (np.diff(starts) < 0).any() \
            or (begins % 3).any():
        raise ValueError('the offsets of EXT_mesh_polygon do not rise')
    polygons = []
    loops = loops.tolist()
    for k in range(len(begins) - 1):
        begin, end = int(begins[k]) // 3, int(begins[k + 1]) // 3
        ring = _only_ring(loops[starts[k]:starts[k + 1]], restart)
        if ring:
            polygons.append(Polygon(ring, begin, end))
        else:
            polygons.extend(Polygon(triangles[i].tolist(), i, i + 1) for i in range(begin, end))
    return polygons


def _only_ring(loop, restart):
    """The ring of a polygon without holes, otherwise nothing."""
    while loop and loop[-1] == restart:
        loop.pop()
    return loop if restart not in loop else None


def is_face(ring):
    """Whether Blender can hold it: three corners or more, on different vertices."""
    return len(ring) >= 3 and len(set(ring)) == len(ring)
