"""File > Export > glTF with polygons."""

import os
import tempfile

import bpy
from bpy.props import BoolProperty, IntProperty
from bpy_extras.io_utils import ExportHelper

from . import command, exporting, report, settings

# What is passed on to Blender's exporter under the same name, with its defaults.
_SCENE = {'use_selection': ('Selected only', False)}
_MESH = {
    'export_apply': ('Apply modifiers', False),
    'export_texcoords': ('UVs', True),
    'export_normals': ('Normals', True),
    'export_colors': ('Vertex colours', True),
    'export_skins': ('Skinning', True),
    'export_morph': ('Shape keys', True),
    'export_animations': ('Animations', True),
    'export_extras': ('Custom properties', False),
}
# Options of `tutte encode`: flag, title, bits unless told otherwise.
_BITS = {
    'position_bits': ('--qp', 'Positions', 14),
    'normal_bits': ('--qn', 'Normals', 10),
    'texcoord_bits': ('--qt', 'UVs', 12),
    'color_bits': ('--qc', 'Colours', 8),
    'generic_bits': ('--qg', 'Others', 12),
}


class ExportTutte(bpy.types.Operator, ExportHelper):
    """Export the scene as compressed glTF that keeps quads and n-gons"""

    bl_idname = 'export_scene.tutte_gltf'
    bl_label = 'Export glTF'
    bl_options = {'PRESET'}
    filename_ext = '.glb'
    filter_glob: bpy.props.StringProperty(default='*.glb', options={'HIDDEN'})
    effort: IntProperty(name='Effort', description='How long to search for fewer bytes', default=1, min=0, max=3)
    __annotations__.update({name: BoolProperty(name=title, default=default)
                            for name, (title, default) in {**_SCENE, **_MESH}.items()})
    __annotations__.update({name: IntProperty(name=title, default=bits, min=0, max=24,
                                              description='Bits per component; 0 keeps them exactly')
                            for name, (_, title, bits) in _BITS.items()})

    def draw(self, _context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        for title, names in (('Include', _SCENE), ('Data', _MESH), ('Bits per component', _BITS)):
            box = self.layout.box()
            box.label(text=title)
            for name in names:
                box.prop(self, name)
        self.layout.prop(self, 'effort')

    def execute(self, _context):
        report.begin()
        try:
            tutte = command.find(settings.command())
            with tempfile.TemporaryDirectory(prefix='tutte-') as folder:
                plain = os.path.join(folder, 'plain.glb')
                self._export(plain)
                result, warnings = command.run(tutte, 'encode', *self._options(), plain, self.filepath)
        except command.TutteError as error:
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        for warning in warnings:
            self.report({'WARNING'}, warning.replace(plain, self.filepath))
        self.report({'INFO'}, result[-1])
        return {'FINISHED'}

    def _export(self, path):
        """Writes the plain file with Blender's own exporter. Raises TutteError."""
        known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
        passed = {name: getattr(self, name) for name in (*_SCENE, *_MESH) if name in known}
        with exporting.with_polygons() as export:
            try:
                bpy.ops.export_scene.gltf(filepath=path, export_format='GLB', **passed)
            except RuntimeError as error:
                raise command.TutteError(f"Blender's glTF exporter failed: {error}") from error
        if export.errors:
            raise command.TutteError(export.errors[0])

    def _options(self):
        bits = [text for name, (flag, *_) in _BITS.items() for text in (flag, getattr(self, name))]
        return [*bits, '--effort', self.effort]


def add_to_menu(menu, _context):
    menu.layout.operator(ExportTutte.bl_idname, text='glTF 2.0 with polygons, compressed (.glb)')
