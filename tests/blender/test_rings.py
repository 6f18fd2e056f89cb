"""The notations of polygons, and the joining of vertices, without a scene."""
import unittest

import numpy as np
from tutte_gltf import rings, seams


def triangles(*corners):
    return np.array(corners, dtype=np.uint32)


class Rings(unittest.TestCase):
    def test_fans(self):
        polygons = rings.of_fans(triangles((0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 7, 8)))
        self.assertEqual([(p.ring, p.begin, p.end) for p in polygons],
                         [([0, 1, 2, 3], 0, 2), ([4, 5, 6], 2, 3), ([4, 7, 8], 3, 4)])

    def test_loops(self):
        polygons = rings.of_loops(triangles((0, 1, 2), (0, 2, 3), (3, 2, 4)), np.array([0, 1, 2, 3, 255, 3, 2, 4]),
                                  np.array([0, 5]), np.array([0, 6]), 255)
        self.assertEqual([(p.ring, p.begin, p.end) for p in polygons], [([0, 1, 2, 3], 0, 2), ([3, 2, 4], 2, 3)])

    def test_a_polygon_with_a_hole_stays_triangles(self):
        polygons = rings.of_loops(triangles((0, 1, 3), (1, 2, 4)), np.array([0, 1, 2, 255, 3, 4, 5]), np.array([0]),
                                  np.array([0]), 255)
        self.assertEqual([p.ring for p in polygons], [[0, 1, 3], [1, 2, 4]])

    def test_offsets_that_fall(self):
        for loops, indices in (([0, 9], [0, 6]), ([0, 4], [0, 9]), ([0, 4], [3, 6]), ([0, 4], [0, 4])):
            with self.assertRaises(ValueError):
                rings.of_loops(triangles((0, 1, 2), (0, 2, 3)), np.arange(6), np.array(loops), np.array(indices), 255)


class Seams(unittest.TestCase):
    def test_two_faces_at_an_edge(self):
        self.assertEqual(seams.joined([[0, 1, 2], [3, 4, 5]], ['a', 'b', 'c', 'b', 'a', 'd']), [0, 1, 2, 1, 0, 5])

    def test_a_corner_alone_joins_nothing(self):
        self.assertEqual(seams.joined([[0, 1, 2], [3, 4, 5]], ['a', 'b', 'c', 'a', 'd', 'e']), [0, 1, 2, 3, 4, 5])

    def test_four_faces_at_a_place_are_two_edges(self):
        values = ['a', 'b', 'c', 'a', 'b', 'd', 'a', 'b', 'e', 'a', 'b', 'f']
        self.assertEqual(seams.joined([[0, 1, 2], [4, 3, 5], [6, 7, 8], [10, 9, 11]], values), list(range(12)))

    def test_three_faces_at_a_place_are_one(self):
        values = ['a', 'b', 'c', 'a', 'b', 'd', 'a', 'b', 'e']
        self.assertEqual(seams.joined([[0, 1, 2], [4, 3, 5], [6, 7, 8]], values), [0, 1, 2, 0, 1, 5, 0, 1, 8])

    def test_front_and_back_do_not_become_one_face(self):
        self.assertEqual(seams.joined([[0, 1, 2], [5, 4, 3]], ['a', 'b', 'c', 'a', 'b', 'c']), list(range(6)))

    def test_no_face_loses_a_corner(self):
        roots = seams.joined([[0, 1, 2, 3], [4, 5, 6]], ['a', 'b', 'a', 'c', 'b', 'a', 'd'])
        self.assertEqual(len({roots[i] for i in range(4)}), 4)
