"""Files that others wrote, and what goes wrong with files."""
import json
import struct
import subprocess
import unittest
from unittest import mock

import bpy
import scenes
from tutte_gltf import rebuild, report, settings

NOWHERE = '/nowhere/tutte'


def set_command(path):
    bpy.context.preferences.addons['tutte_gltf'].preferences.command = path


class Files(unittest.TestCase):
    def setUp(self):
        scenes.reset()
        self.addCleanup(set_command, settings.command())
        self.folder = scenes.scratch()
        self.obj = self.folder / 'drum.obj'
        points = '\n'.join(f'v {x} {y} {z}' for z in (0, 1) for x, y, _ in scenes.STAR)
        sides = '\n'.join(f'f {i + 1} {(i + 1) % 8 + 1} {(i + 1) % 8 + 9} {i + 9}' for i in range(8))
        self.obj.write_text(f'{points}\n{sides}\nf {" ".join(map(str, range(9, 17)))}\n')
        self.degrees = [4] * 8 + [8]

    def encode(self, name, *options, source=None):
        path = self.folder / name
        subprocess.run([settings.command(), 'encode', *options, source or self.obj, path], check=True,
                       stdout=subprocess.DEVNULL)
        return path

    def load_with(self, command, path, **options):
        scenes.reset()
        set_command(command)
        return bpy.ops.import_scene.gltf(filepath=str(path), **options)

    def imported_degrees(self):
        return sorted(face.loop_total for mesh in bpy.data.meshes for face in mesh.polygons)

    def test_both_notations_and_both_containers(self):
        for name, polygons in (('a.glb', 'ext'), ('b.glb', 'both'), ('c.gltf', 'ext')):
            with self.subTest(name):
                scenes.load(self.encode(name, '--polygons', polygons))
                self.assertEqual(self.imported_degrees(), self.degrees)
                self.assertEqual(len(bpy.data.meshes[0].vertices), 16)

    def test_fans(self):
        grid = self.folder / 'grid.obj'
        grid.write_text(''.join(f'v {x} {y} 0\n' for y in range(3) for x in range(3)) +
                        ''.join(f'f {i} {i + 1} {i + 4} {i + 3}\n' for i in (1, 2, 4, 5)))
        scenes.load(self.encode('fans.glb', '--polygons', 'fb', source=grid))
        self.assertEqual(self.imported_degrees(), [4] * 4)

    def test_plain_file_with_polygons(self):
        plain = self.folder / 'plain.glb'
        subprocess.run([settings.command(), 'decode', self.encode('a.glb'), plain], check=True,
                       stdout=subprocess.DEVNULL)
        self.load_with(NOWHERE, plain)
        self.assertEqual(self.imported_degrees(), self.degrees)

    def test_plain_file_without_polygons(self):
        scenes.add_grid('grid')
        plain = self.folder / 'plain.glb'
        bpy.ops.export_scene.gltf(filepath=str(plain))
        length, = struct.unpack_from('<I', plain.read_bytes(), 12)
        self.assertNotIn('EXT_mesh_polygon', json.loads(plain.read_bytes()[20:20 + length])['meshes'][0]['primitives'])
        self.load_with(NOWHERE, plain)
        self.assertEqual(self.imported_degrees(), [3] * 50)
        self.assertEqual(report.warnings, [])

    def test_faces_that_blender_cannot_hold(self):
        odd = self.folder / 'odd.obj'
        odd.write_text(''.join(f'v {x} {y} 0\n' for y in range(2) for x in range(4)) +
                       # a quad, its back, a quad, one that visits a vertex twice, half of the quad before
                       'f 1 2 6 5\nf 5 6 2 1\nf 2 3 7 6\nf 3 4 8 4\nf 2 3 7\n')
        scenes.load(self.encode('odd.glb', source=odd))
        mesh = bpy.data.meshes[0]
        places = sorted(tuple(sorted(round(mesh.vertices[i].co.x) for i in face.vertices)) for face in mesh.polygons)
        self.assertEqual(places, [(0, 0, 1, 1), (1, 1, 2, 2), (1, 2, 2), (2, 3, 3)])
        self.assertRegex(report.warnings[0], "The mesh 'odd' has . faces that Blender cannot hold")

    def test_merge_vertices_is_no_obstacle(self):
        scenes.load(self.encode('a.glb'), merge_vertices=True)
        self.assertEqual(self.imported_degrees(), self.degrees)

    def test_without_tutte_import_says_so(self):
        path = self.encode('a.glb')
        with self.assertRaisesRegex(RuntimeError, 'Tutte: /nowhere/tutte is no program. Correct the path'):
            self.load_with(NOWHERE, path)
        self.assertEqual(len(bpy.data.meshes), 0)

    def test_not_on_path(self):
        path = self.encode('a.glb')
        with mock.patch.dict('os.environ', PATH='/nowhere'):
            with self.assertRaisesRegex(RuntimeError, "Tutte: The command 'tutte' is not on PATH. Install it"):
                self.load_with('', path)

    def test_without_tutte_export_says_so(self):
        scenes.add_grid('grid')
        set_command(NOWHERE)
        with self.assertRaisesRegex(RuntimeError, 'is no program. Correct the path'):
            scenes.export(self.folder / 'grid.glb')
        self.assertFalse((self.folder / 'grid.glb').exists())

    def test_without_tutte_the_fallback_is_read(self):
        path = self.encode('a.glb', '--fallback')
        self.assertEqual(self.load_with(NOWHERE, path), {'FINISHED'})
        self.assertEqual(self.imported_degrees(), self.degrees)
        self.assertRegex(report.warnings[0], 'The uncompressed copy inside the file was read instead')

    def test_damaged_file(self):
        path = self.encode('a.glb')
        data = bytearray(path.read_bytes())
        data[data.index(b'TUTT\0') + 40] ^= 255
        path.write_bytes(data)
        with self.assertRaisesRegex(RuntimeError, 'Tutte: .*a.glb'):
            scenes.load(path)

    def test_a_failing_hook_is_seen(self):
        path = self.encode('a.glb')
        with mock.patch.object(rebuild, 'give_polygons', side_effect=ValueError('on purpose')):
            scenes.load(path)
        self.assertEqual(report.warnings, ["The mesh 'drum' keeps its triangles: on purpose"])
        self.assertEqual(set(self.imported_degrees()), {3})

    def test_a_failing_export_hook_leaves_no_file(self):
        scenes.add_grid('grid')
        with mock.patch('tutte_gltf.exporting._add_polygons', side_effect=ValueError('on purpose')):
            with self.assertRaisesRegex(RuntimeError, "The polygons of 'grid' cannot be written: on purpose"):
                scenes.export(self.folder / 'grid.glb')
        self.assertFalse((self.folder / 'grid.glb').exists())

    def test_images_beside_a_gltf_file(self):
        image = bpy.data.images.new('checker', 4, 4)
        image.filepath_raw, image.file_format = str(self.folder / 'checker.png'), 'PNG'
        image.save()
        grid = scenes.add_grid('grid')
        scenes.add_uvs(grid)
        scenes.add_materials(grid, 'checked')
        tree = grid.data.materials[0]
        tree.use_nodes = True
        node = tree.node_tree.nodes.new('ShaderNodeTexImage')
        node.image = image
        tree.node_tree.links.new(node.outputs['Color'], tree.node_tree.nodes['Principled BSDF'].inputs['Base Color'])
        scenes.export(self.folder / 'a.glb')
        path = self.encode('b.gltf', source=self.folder / 'a.glb')
        scenes.load(path)
        self.assertEqual([image.size[:] for image in bpy.data.images if image.name == 'checker'], [(4, 4)])
        self.assertEqual(self.imported_degrees(), [4] * 25)
