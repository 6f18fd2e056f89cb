#!/usr/bin/env python3
"""What each attribute coder makes of real models: the table of docs/attributes_ablation.md.

    attributes_ablation.py TUTTE CORPUS

Positions of 12 bits, all models of four folders of the corpus; Draco's compression level 10 is 1.
"""
import json
import subprocess
import sys
from pathlib import Path

FOLDERS = ('polygon', 'paper-polygon', 'paper-triangle', 'triangle')
CODERS = (("Draco's classes over our connectivity", ['--attribute-coder', 'draco']),
          ('classes, without tangent planes (`fast`)', ['--attribute-coder', 'tutte', '--profile', 'fast']),
          ('classes, two contexts (`default`)', ['--attribute-coder', 'tutte', '--profile', 'default']),
          ('eight contexts, mixed (`small`)', ['--attribute-coder', 'tutte', '--profile', 'small']),
          ('the choice of `encode`', []))


def measure(tutte, files, options):
    command = [tutte, 'bench', '--json', '--seconds', '0', '--attributes', 'POSITION', '--qp', '12', *options, *files]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    models = [model for model in map(json.loads, lines) if model.get('draco_cl10')]
    def total(key):
        return sum(model[key] for model in models) / sum(model['draco_cl10'][key] for model in models)
    return total('attribute_bytes'), total('total_bytes')


def main(tutte, corpus):
    print('| coder | ' + ' | '.join(f'{folder}: attributes, total' for folder in FOLDERS) + ' |')
    print('|---' * (len(FOLDERS) + 1) + '|')
    for name, options in CODERS:
        cells = []
        for folder in FOLDERS:
            files = [str(path) for path in sorted((Path(corpus) / folder).iterdir())]
            cells.append('{:.3f}, {:.3f}'.format(*measure(tutte, files, options)))
        print(f'| {name} | ' + ' | '.join(cells) + ' |', flush=True)


if __name__ == '__main__':
    main(*sys.argv[1:])
