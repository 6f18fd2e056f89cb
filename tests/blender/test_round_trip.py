"""Blender to GLB and back: nothing that a modeller made may be lost."""
import unittest

import bpy
import scenes
from tutte_gltf import report


class RoundTrip(unittest.TestCase):
    tolerance = 1e-3

    def setUp(self):
        scenes.reset()
        self.path = scenes.scratch() / 'model.glb'

    def passes(self, *names, **options):
        """Exports and imports the objects; the shapes before and after, by name."""
        before = {name: scenes.Shape(bpy.data.objects[name]) for name in names}
        self.assertEqual(scenes.export(self.path, **options), {'FINISHED'})
        self.assertEqual(scenes.load(self.path), {'FINISHED'})
        self.assertEqual(report.warnings, [])
        after = {name: scenes.Shape(bpy.data.objects[name]) for name in names}
        for name in names:
            self.assert_same_faces(before[name], after[name])
        return before, after

    def assert_same_faces(self, before, after):
        self.assertEqual(len(before.points), len(after.points))
        at = after.vertices_in(before, self.tolerance)
        self.assertEqual(len(set(at)), len(at))
        faces = [tuple(at[vertex] for vertex in face) for face in after.faces]
        self.assertEqual(scenes.count_faces(before.faces), scenes.count_faces(faces))
        before_by_face = {scenes.turned(face): number for number, face in enumerate(before.faces)}
        partners = [before_by_face[scenes.turned(face)] for face in faces]
        self.assertEqual([before.materials[number] for number in partners], after.materials)
        self.assert_same_corners(before, after, at, partners)

    def assert_same_corners(self, before, after, at, partners):
        corners = before.corners()
        for (number, vertex), corner in after.corners().items():
            partner = corners[partners[number], at[vertex]]
            cosine = before.normals[partner].normalized().dot(after.normals[corner].normalized())
            self.assertGreater(cosine, .9999)
            for old, new in zip(before.uvs[partner], after.uvs[corner]) if before.uvs else ():
                self.assertAlmostEqual(old, new, delta=1e-3)

    def test_quads(self):
        scenes.add_grid('grid')
        self.passes('grid')

    def test_n_gons(self):
        scenes.add_drum('drum')
        before, after = self.passes('drum')
        self.assertEqual(before['drum'].smooth, after['drum'].smooth)

    def test_concave_n_gon(self):
        scenes.add_star('star')
        self.passes('star')

    def test_seams_and_sharp_edges_do_not_split(self):
        scenes.add_uvs(scenes.add_drum('drum'))
        self.passes('drum')

    def test_smooth_with_uvs(self):
        scenes.add_uvs(scenes.add_grid('grid'))
        before, after = self.passes('grid')
        self.assertEqual(before['grid'].smooth, after['grid'].smooth)

    def test_parts_that_touch_stay_apart(self):
        scenes.add_cubes('cubes', (0, 0, 0), (1, 1, 0), (2, 1, 1))
        before = scenes.Shape(bpy.data.objects['cubes'])
        scenes.export(self.path)
        scenes.load(self.path)
        after = scenes.Shape(bpy.data.objects['cubes'])
        self.assertEqual(len(before.points), len(after.points))
        self.assertEqual([len(face) for face in after.faces], [4] * 18)

    def test_what_quantisation_moves_together_stays_apart(self):
        gap = 1e-5
        scenes.add('strips', [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 1 + gap, 0), (1, 1 + gap, 0), (1, 9, 0),
                              (0, 9, 0)], [(0, 1, 2, 3), (4, 5, 6, 7)])
        scenes.export(self.path)
        scenes.load(self.path)
        self.assertEqual(len(bpy.data.objects['strips'].data.vertices), 8)

    def test_materials(self):
        scenes.add_materials(scenes.add_drum('drum'), 'red', 'green', 'blue')
        self.passes('drum')

    def test_material_on_no_face(self):
        drum = scenes.add_drum('drum')
        scenes.add_materials(drum, 'red')
        drum.data.materials.append(None)
        self.passes('drum')

    def test_shape_keys(self):
        drum = scenes.add_drum('drum')
        scenes.add_materials(drum, 'red', 'green')
        drum.shape_key_add(name='Basis')
        for name, height in (('tall', 2), ('flat', -.5)):
            for point in drum.shape_key_add(name=name).data:
                point.co.z += height * point.co.z
        before, after = self.passes('drum')
        self.assertEqual(list(before['drum'].shapes), list(after['drum'].shapes))
        at = after['drum'].vertices_in(before['drum'], self.tolerance)
        for name, points in before['drum'].shapes.items():
            for old, new in zip(at, after['drum'].shapes[name]):
                self.assertLess((points[old] - new).length, 2e-3)

    def test_armature(self):
        bpy.ops.object.armature_add()
        armature = bpy.context.object
        bpy.ops.object.mode_set(mode='EDIT')
        tip = armature.data.edit_bones.new('tip')
        tip.parent = armature.data.edit_bones['Bone']
        tip.head, tip.tail = (0, 0, 1), (0, 0, 2)
        bpy.ops.object.mode_set(mode='OBJECT')
        drum = scenes.add_drum('drum', smooth=True)
        for name, own in (('Bone', 0), ('tip', 1)):
            group = drum.vertex_groups.new(name=name)
            for vertex in drum.data.vertices:
                group.add([vertex.index], .75 if vertex.co.z == own else .25, 'REPLACE')
        drum.parent = armature
        drum.modifiers.new('Armature', 'ARMATURE').object = armature
        before, after = self.passes('drum')
        at = after['drum'].vertices_in(before['drum'], self.tolerance)
        for old, weights in zip(at, after['drum'].weights):
            self.assertEqual(before['drum'].weights[old].keys(), weights.keys())
            for name, weight in weights.items():
                self.assertAlmostEqual(before['drum'].weights[old][name], weight, delta=1e-3)
        self.assertEqual({bone.name for bone in bpy.data.armatures[0].bones}, {'Bone', 'tip'})

    def test_two_objects_and_a_linked_duplicate(self):
        drum, star = scenes.add_drum('drum'), scenes.add_star('star')
        scenes.link('twin', drum.data).location = (5, 0, 0)
        star.location = (0, 0, 3)
        self.passes('drum', 'star', 'twin')
        self.assertEqual(bpy.data.objects['drum'].data, bpy.data.objects['twin'].data)
        self.assertEqual(len(bpy.data.meshes), 2)
        self.assertEqual(tuple(bpy.data.objects['twin'].location), (5, 0, 0))

    def test_linked_duplicate_with_another_material(self):
        drum = scenes.add_drum('drum')
        drum.data.materials.append(bpy.data.materials.new('red'))
        twin = scenes.link('twin', drum.data)
        twin.material_slots[0].link = 'OBJECT'
        twin.material_slots[0].material = bpy.data.materials.new('green')
        self.assertEqual(scenes.export(self.path), {'FINISHED'})
        scenes.load(self.path)
        for name, material in (('drum', 'red'), ('twin', 'green')):
            mesh = bpy.data.objects[name].data
            self.assertEqual(len(mesh.polygons), 26)
            self.assertEqual(mesh.materials[0].name, material)

    def test_modifiers_are_applied_on_demand(self):
        grid = scenes.add_grid('grid')
        grid.modifiers.new('Mirror', 'MIRROR').use_axis = (False, False, True)
        self.assertEqual(scenes.export(self.path, export_apply=True), {'FINISHED'})
        scenes.load(self.path)
        self.assertEqual([face.loop_total for face in bpy.data.objects['grid'].data.polygons], [4] * 50)

    def test_without_loss(self):
        scenes.add_grid('grid')
        self.tolerance = 1e-7
        self.passes('grid', position_bits=0)

    def test_selection_only(self):
        scenes.add_grid('grid')
        scenes.add_star('star').select_set(True)
        scenes.export(self.path, use_selection=True)
        scenes.load(self.path)
        self.assertEqual([thing.name for thing in bpy.data.objects], ['star'])
