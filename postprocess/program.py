# SPDX-License-Identifier: GPL-3.0-only
"""Runs sprag for scripts that need results of their own."""

import os
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


class RunFailed(Exception):
    """sprag did not finish a scene; the text says which and what it said."""


def add_program(parser):
    parser.add_argument("--sprag", type=Path, default=program(), metavar="FILE", help="the program (the one built or installed with this script)")


def program():
    """What the environment names by SPRAG, the one built or installed with these scripts, or the one on the path."""
    beside = (ROOT / "build" / "sprag", ROOT.parent.parent / "bin" / "sprag")
    found = [path for path in beside if path.exists()]
    return Path(os.environ.get("SPRAG") or (found[0] if found else shutil.which("sprag") or beside[0]))


def run_scene(sprag, scene, output, changes):
    """A scene with changes as {"Section/Name": value} into a folder. Throws RunFailed."""
    command = [sprag, scene, "--output", output, "--quiet", "--overwrite"]
    for parameter, value in changes.items():
        command += ["--set", f"{parameter}={value}"]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, check=False)
    except OSError as error:
        raise RunFailed(f"{sprag}: {error.strerror}") from error
    if done.returncode != 0:
        raise RunFailed(f"{Path(scene).name}: sprag ended with {done.returncode}\n{done.stdout.strip()}")
