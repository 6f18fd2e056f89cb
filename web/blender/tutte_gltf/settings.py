"""The add-on's preferences, and how the rest of it reads them."""

from functools import lru_cache

import bpy
from bpy.props import BoolProperty, StringProperty

from . import command as tutte

_PACKAGE = __package__


class TuttePreferences(bpy.types.AddonPreferences):
    """Shown in Preferences > Add-ons > Tutte."""

    bl_idname = _PACKAGE

    command: StringProperty(
        name='Command',
        description="Where the command 'tutte' is; empty: the one on PATH",
        subtype='FILE_PATH',
    )
    join_vertices: BoolProperty(
        name='Join vertices at seams',
        description='Make one vertex again of those that glTF splits where texture coordinates or normals jump',
        default=True,
    )

    def draw(self, _context):
        self.layout.prop(self, 'command')
        self.layout.prop(self, 'join_vertices')
        try:
            path = tutte.find(self.command)
            self.layout.label(text=f'{path}, version {_version(path)}', icon='CHECKMARK')
        except tutte.TutteError as error:
            self.layout.label(text=str(error).split('. ')[0], icon='ERROR')  # the remedy is here


@lru_cache
def _version(path):
    """Remembered, because preferences are drawn often."""
    return ' '.join(tutte.run(path, '--version')[0])


def _preferences():
    return bpy.context.preferences.addons[_PACKAGE].preferences


def command():
    return _preferences().command


def join_vertices():
    return _preferences().join_vertices
