# SPDX-License-Identifier: GPL-3.0-only
"""Runs the program sprag."""

import os
import shutil
import subprocess
import tempfile
import weakref
from os import PathLike
from pathlib import Path
from typing import Any, Mapping, Optional, Sequence, Union

from .parameters import Parameter, parse, scene_text, schema, set_apart, slug
from .results import Result, read_result

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
    found = next((str(path) for path in beside if path.exists()), None) or shutil.which("sprag")
    return Path(os.environ.get("SPRAG") or found or beside[0])


def run_scene(sprag, scene, output, changes, jobs=None, progress=False):
    """Runs a scene with changes {"Section/Name": value} into a folder, replacing what is there. Throws Refused or Failed."""
    count = [] if jobs is None else ["--jobs", str(jobs)]
    quiet = [] if progress else ["--quiet"]
    read_output([sprag, scene, "--output", output, *quiet, "--overwrite", *settings(changes), *count], progress)


def settings(changes):
    return [word for parameter, value in changes.items() for word in ("--set", f"{parameter}={value}")]


def read_output(command, shows=False):
    """Returns the program's output for a scene, the second word of the command; shows it as it comes. Throws Refused or Failed."""
    sprag, scene, *_ = command
    lines = []
    try:
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True) as process:
            try:
                for line in process.stdout or ():
                    lines.append(line)
                    if shows:
                        print(line, end="", flush=True)
            except BaseException:
                process.kill()
                raise
    except OSError as error:
        raise Failed(f"{sprag}: {error.strerror}") from error
    if process.returncode != 0:
        kind = Refused if process.returncode == 2 else Failed
        raise kind(f"{Path(scene).name}: sprag ended with {process.returncode}\n{''.join(lines).strip()}")
    return "".join(lines)


class Section:
    """A section of a Scene: its attributes are the Parameters; what they are set to is a change of the scene."""

    _scene: "Scene"
    _names: dict[str, str]

    def __init__(self, scene, name):
        names = {slug(full.partition("/")[2]): full for full in scene.parameters if full.startswith(name + "/")}
        self.__dict__.update(_scene=scene, _names=names)

    def __dir__(self):
        return self._names

    def __getattr__(self, name: str) -> Parameter:
        return self._scene.parameters[self._full(name)]

    def __setattr__(self, name: str, value: object) -> None:
        self._scene.changes[self._full(name)] = value

    def _full(self, name):
        if name not in self._names:
            raise AttributeError(f"no {name}; there are {', '.join(self._names)}")
        return self._names[name]


class Scene:
    """A parameter file and changes {"Section/Name": value}: scene.lever.depth is a Parameter with text, number, unit, range and meaning,
    scene.lever.depth = 12 sets it. What reads parameters, as run() does, throws Refused where they do not go together."""

    def __init__(self, path: Union[str, PathLike], changes: Optional[Mapping[str, Any]] = None) -> None:
        self.path, self.changes = path, dict(changes or {})
        self._read: Optional[tuple] = None
        self.__dict__.update({slug(name): Section(self, name) for name in {full.partition("/")[0]: None for full in self.parameters}})

    def __getattr__(self, name: str) -> Section:
        sections = [key for key, value in vars(self).items() if isinstance(value, Section)]
        raise AttributeError(f"no {name}; there are {', '.join(sections)}")

    def __setattr__(self, name: str, value: object) -> None:
        if name not in ("path", "changes", "_read"):
            raise AttributeError(f"{name} cannot be set; parameters are set in their section, as scene.lever.depth = 12")
        super().__setattr__(name, value)

    @property
    def parameters(self) -> "dict[str, Parameter]":
        """{"Section/Name": Parameter} of all, as used."""
        if self._read is None or self._read[0] != self.changes:
            self._read = dict(self.changes), parse(read_output([program(), self.path, *settings(self.changes), "--print-parameters"]))
        return self._read[1]

    def schema(self) -> dict:
        """The JSON schema of all parameters, a dictionary."""
        return schema(self.parameters)

    def __str__(self):
        """The scene as a parameter file: what is set apart from defaults."""
        return scene_text(set_apart(self.parameters))


def run(
    scene: Union[Scene, str, PathLike],
    changes: Optional[Mapping[str, Any]] = None,
    output: Union[str, PathLike, None] = None,
    jobs: Optional[int] = None,
    progress: bool = False,
) -> Result:
    """The Result of a scene.

    scene: a Scene, or the path of a parameter file. changes: {"Section/Name": value}, in the units of the parameter file. output: folder of the
    result, replaced if it is there; without one it is temporary and goes with the Result. jobs: processes of a study or map.
    progress: prints what the program says while it runs. Throws Refused or Failed with the program's message.
    """
    path, known = (scene.path, scene.changes) if isinstance(scene, Scene) else (scene, {})
    folder = Path(output or tempfile.mkdtemp(prefix="sprag-run-"))
    try:
        run_scene(program(), path, folder, {**known, **(changes or {})}, jobs, progress)
        result = read_result(folder)
    except BaseException:
        if output is None:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    if output is None:
        weakref.finalize(result, shutil.rmtree, folder, ignore_errors=True)
    return result


def sweep(
    scene: Union[Scene, str, PathLike],
    values: Mapping[str, Sequence],
    changes: Optional[Mapping[str, Any]] = None,
    output: Union[str, PathLike, None] = None,
    jobs: Optional[int] = None,
    progress: bool = False,
) -> Result:
    """The Result of a study of a scene over all combinations of values {"Section/Name": sequence}; else as run(). Each run is of the
    scene's Analysis/Type, or of that in changes, there Study/Type as well."""
    known = {**(scene.changes if isinstance(scene, Scene) else {}), **(changes or {})}
    kind = known.get("Study/Type") or known.get("Analysis/Type")
    if kind in (None, "study"):
        parameters = Scene(scene.path if isinstance(scene, Scene) else scene, known).parameters
        kind = parameters["Analysis/Type"].text
        kind = parameters["Study/Type"].text if kind == "study" else kind
    vary = "; ".join(f"{name} = {', '.join(map(str, numbers))}" for name, numbers in values.items())
    study = {"Analysis/Type": "study", "Study/Type": kind, "Study/Vary": vary}
    return run(scene, {**(changes or {}), **study}, output, jobs, progress)
