#!/usr/bin/env python3
"""Packs the add-on for Preferences > Add-ons > Install: package.py FILE.zip"""
import sys
import zipfile
from pathlib import Path

folder = Path(__file__).parent
with zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED) as archive:
    for path in sorted((folder / 'tutte_gltf').glob('*.py')):
        archive.write(path, path.relative_to(folder))
    archive.write(folder.parents[1] / 'LICENSE', 'tutte_gltf/LICENSE')
