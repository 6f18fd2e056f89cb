"""Runs inside Blender: installs the add-on from its archive and tests it there.

  blender --background --factory-startup --python-exit-code 1 --python run.py -- TUTTE ADDON.zip

BLENDER_USER_SCRIPTS names a folder to install into.
"""
import sys
import unittest
from pathlib import Path

import bpy

tutte, archive = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.preferences.addon_install(filepath=archive)
bpy.ops.preferences.addon_enable(module='tutte_gltf')
bpy.context.preferences.addons['tutte_gltf'].preferences.command = tutte

folder = Path(__file__).parent
sys.path.insert(0, str(folder))
tests = unittest.defaultTestLoader.discover(str(folder), pattern='test_*.py')
result = unittest.TextTestRunner(verbosity=2).run(tests)
sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
