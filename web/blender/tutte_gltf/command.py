"""Finds and runs the command `tutte`, which does all compression."""

import os
import shutil
import subprocess


class TutteError(RuntimeError):
    """What went wrong and what to do about it, in words for the user."""


def find(preferred=''):
    """The path of `tutte`: the one that is named, or that on PATH. Raises TutteError."""
    if preferred:
        path = os.path.expanduser(preferred)
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
        raise TutteError(f'{path} is no program. Correct the path in Preferences > Add-ons > Tutte')
    found = shutil.which('tutte')
    if found:
        return found
    raise TutteError("The command 'tutte' is not on PATH. Install it, or name it in Preferences > Add-ons > Tutte")


def run(path, *arguments):
    """Runs `tutte` and returns what it prints and what it warns of, both as lists of lines. Raises TutteError."""
    try:
        done = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, encoding='utf-8',
                              errors='replace', stdin=subprocess.DEVNULL, check=False)
    except OSError as error:
        raise TutteError(f'{path} does not run: {error.strerror}. '
                         'Correct the path in Preferences > Add-ons > Tutte') from error
    warnings = done.stderr.strip().splitlines()
    if done.returncode != 0:
        raise TutteError(warnings[-1] if warnings else f'{path} ended with code {done.returncode}')
    return done.stdout.strip().splitlines(), warnings
