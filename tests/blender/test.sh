#!/usr/bin/env bash
# The add-on in Blender without a window: test.sh TUTTE FOLDER. Ends with 77 where there is no Blender.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
tutte=$1 folder=$2
if ! command -v blender >/dev/null || ! blender --background --python-exit-code 1 --python-expr 'import numpy' >/dev/null; then
  echo "skipped: Blender with numpy is not installed; ./dev blender-test installs it"
  exit 77
fi
rm -rf "$folder"
mkdir -p "$folder/scripts"
python3 "$here/../../web/blender/package.py" "$folder/tutte_gltf.zip"
BLENDER_USER_SCRIPTS=$folder/scripts TMPDIR=$folder PYTHONDONTWRITEBYTECODE=1 blender --background --factory-startup \
  --python-exit-code 1 --python "$here/run.py" -- "$tutte" "$folder/tutte_gltf.zip"
