"""glTF with polygons in Blender: reads and writes TUTTE_mesh_compression through Blender's own glTF add-on."""

import bpy

from .exporting import glTF2ExportUserExtension  # noqa: F401  found here by Blender's glTF add-on
from .importing import glTF2ImportUserExtension  # noqa: F401
from .operator import ExportTutte, add_to_menu
from .settings import TuttePreferences

bl_info = {
    'name': 'Tutte: glTF with polygons',
    'author': 'The Tutte authors',
    'version': (0, 1, 0),
    'blender': (3, 4, 0),
    'location': 'File > Import > glTF 2.0, File > Export > glTF 2.0 with polygons',
    'description': "Compressed glTF that keeps quads and n-gons (TUTTE_mesh_compression). Needs the command 'tutte'",
    'category': 'Import-Export',
}


def register():
    bpy.utils.register_class(TuttePreferences)
    bpy.utils.register_class(ExportTutte)
    bpy.types.TOPBAR_MT_file_export.append(add_to_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(add_to_menu)
    bpy.utils.unregister_class(ExportTutte)
    bpy.utils.unregister_class(TuttePreferences)
