# SPDX-License-Identifier: GPL-3.0-only
"""Runs the program sprag."""

import os
import shutil
import subprocess
import tempfile
import weakref
from pathlib import Path

from .parameters import parse
from .results import read_result

ROOT = Path(__file__).resolve().parents[2]


class RunFailed(Exception):
    """sprag did not finish a scene; the text is what it said."""


class Refused(RunFailed):
    """The scene, or a value in it, is wrong."""


class Failed(RunFailed):
    """The analysis failed, or was stopped."""


def program():
    """The path of the program: from the environment variable SPRAG, built or installed with this package, or on the PATH."""
    beside = (ROOT / "build" / "sprag", ROOT.parent.parent / "bin" / "sprag")
    found = [path for path in beside if path.exists()]
    return Path(os.environ.get("SPRAG") or (found[0] if found else shutil.which("sprag") or beside[0]))


def run_scene(sprag, scene, output, changes, jobs=None):
    """Runs a scene with changes {"Section/Name": value} into a folder, replacing what is there. Throws Refused or Failed."""
    command = [sprag, scene, "--output", output, "--quiet", "--overwrite"]
    for parameter, value in changes.items():
        command += ["--set", f"{parameter}={value}"]
    if jobs is not None:
        command += ["--jobs", str(jobs)]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, check=False)
    except OSError as error:
        raise Failed(f"{sprag}: {error.strerror}") from error
    if done.returncode != 0:
        kind = Refused if done.returncode == 2 else Failed
        raise kind(f"{Path(scene).name}: sprag ended with {done.returncode}\n{done.stdout.strip()}")


def run(scene, changes=None, output=None, jobs=None):
    """The Result of a scene.

    scene: path of a parameter file. changes: {"Section/Name": value}, in the units of the parameter file. output: folder of the
    result, replaced if it is there; without one it is temporary and goes with the Result. jobs: processes of a study or map.
    Throws Refused or Failed with the program's message.
    """
    folder = Path(output or tempfile.mkdtemp(prefix="sprag-run-"))
    try:
        run_scene(program(), scene, folder, changes or {}, jobs)
        result = read_result(folder)
    except BaseException:
        if output is None:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    if output is None:
        weakref.finalize(result, shutil.rmtree, folder, ignore_errors=True)
    return result


def sweep(scene, values, changes=None, output=None, jobs=None):
    """The Result of a study (Type = study) of a scene over all combinations of values {"Section/Name": sequence}; else as run()."""
    text = Path(scene).read_text(encoding="utf-8")
    kind = (changes or {}).get("Analysis/Type") or parse(text).get("Analysis/Type")
    vary = "; ".join(f"{name} = {', '.join(map(str, numbers))}" for name, numbers in values.items())
    study = {"Analysis/Type": "study", "Study/Type": getattr(kind, "text", kind) or "quasi-static", "Study/Vary": vary}
    return run(scene, {**(changes or {}), **study}, output, jobs)
