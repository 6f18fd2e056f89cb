#!/usr/bin/env python3
"""Runs the commands of README.md's `sh` blocks that begin with `tutte`, on a model made here.

  readme.py README TUTTE FOLDER
"""
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

readme, tutte, folder = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)

lines = [f'v {x} {y} {x * y % 7}' for y in range(20) for x in range(20)]
lines += [f'f {a} {a + 1} {a + 21} {a + 20}' for y in range(19) for a in range(20 * y + 1, 20 * y + 20)]
(folder / 'model.obj').write_text('\n'.join(lines) + '\n')

blocks = re.findall(r'```sh\n(.*?)```', readme.read_text(), re.DOTALL)
commands = [line for block in blocks for line in block.splitlines() if line.startswith('tutte ')]
for command in commands:
    arguments = [tutte] + shlex.split(command, comments=True)[1:]
    run = subprocess.run(arguments, cwd=folder, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f'{command}: exit code {run.returncode}\n{run.stdout}{run.stderr}')
print(f'{len(commands)} commands run')
sys.exit(0 if commands else 'README.md has no commands')
