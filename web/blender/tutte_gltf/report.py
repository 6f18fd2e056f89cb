"""Warnings that everybody sees: the glTF importer swallows what its hooks raise, so they must speak for themselves."""

import sys

import bpy

warnings = []  # of the last import or export


def begin():
    warnings.clear()


def warn(text):
    """Prints the text and, where there is a window, shows it."""
    warnings.append(text)
    print(f'Tutte: {text}', file=sys.stderr)
    if not bpy.app.background:
        bpy.context.window_manager.popup_menu(lambda menu, _context: menu.layout.label(text=text), title='Tutte',
                                              icon='ERROR')
