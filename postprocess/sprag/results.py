# SPDX-License-Identifier: GPL-3.0-only
"""Reads result.h5 as written by sprag, finished or not, and the fields beside it."""

from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
import re
import time
from typing import Any, NamedTuple, Optional, Union

import h5py  # type: ignore[import]
import numpy as np

from .parameters import parse

KNOWN = ("table", "face", "summary", "meta")
WAYS = {"forward": 1, "backward": -1}


class NotAResult(Exception):
    """The folder holds no result of sprag, or not what was asked for; the text says which and why."""


class Column(np.ndarray):
    """Numbers with the attributes unit, "1" where they have none, and description. What is computed of it is a plain array."""

    unit = "1"
    description = ""

    def __array_finalize__(self, whole):
        self.unit, self.description = getattr(whole, "unit", "1"), getattr(whole, "description", "")

    def __array_wrap__(self, computed, *context):
        return computed.view(np.ndarray) if computed.ndim else computed[()]


class Number(float):
    """A number with the attributes unit, "1" where it has none, and description; more of the file in the dictionary more."""

    unit: str
    description: str
    more: dict


class Text(str):
    """A text with the same attributes; a warning's more has its "effect" and "remedy"."""

    unit: str
    description: str
    more: dict


def described(value, attributes):
    """An array, number or text of a file with its unit and description; arrays of texts as they are."""
    if isinstance(value, np.ndarray):
        if value.dtype.kind not in "fiu":
            return value
        value = value.view(Column)
    else:
        value = Text(value) if isinstance(value, str) else Number(value)
        value.more = dict(attributes)
    value.unit, value.description = attributes.get("unit", "1"), attributes.get("description", "")
    return value


class FaceState(NamedTuple):
    """The friction face at one step."""

    time: float  # [s]
    x: float  # of the cylinder [mm]
    xi: Column  # of the points, along the lever from the pivot [mm]
    zeta: Optional[Column]  # in three dimensions across it [mm]
    pressure: Column  # [MPa]
    traction: Column  # of friction on the lever, towards the pivot [MPa]


class Rows:
    """A quantity of the friction face [written steps x points]: rows[step] reads that step, numpy.asarray(rows) all of them."""

    def __init__(self, path, name, steps, order):
        self.path, self.name, self.steps, self.order = path, name, steps, order
        self.known = {}

    def __getitem__(self, step):
        if step not in self.known:
            with open_result(self.path) as file:
                data = file["face"][self.name]
                self.known[step] = described(data[range(self.steps)[step]][self.order], data.attrs)
        return self.known[step]

    def __array__(self, dtype=None):
        with open_result(self.path) as file:
            return file["face"][self.name][: self.steps][:, self.order].astype(dtype or float)


@dataclass
class Face:
    """The friction face at the steps that were written."""

    xi: Column  # of the points [mm]
    weight: np.ndarray  # area of each [mm^2]
    time: np.ndarray  # of the steps [s]
    x: np.ndarray  # of the cylinder at these steps [mm]
    pressure: Rows  # [MPa]
    traction: Rows  # of friction [MPa]
    zeta: Optional[Column] = None  # across the width, in three dimensions

    def find_rows(self, times):
        """The rows of a table at these times in which the steps stand."""
        return np.searchsorted(times, self.time - 1e-9 * np.abs(self.time)).clip(max=len(times) - 1)


@dataclass(repr=False)
class Result:
    """One result folder. Columns and entries have the attributes unit and description."""

    folder: Path
    table: dict[str, Column]  # all equally long
    parameters: str
    summary: dict[str, Any] = field(default_factory=dict)  # entry -> Number or Text; empty while the run goes on
    meta: dict = field(default_factory=dict)  # versions, cost, sizes
    friction_face: Optional[Face] = None
    groups: dict = field(default_factory=dict)  # other groups: name -> {dataset -> array or entry}
    finished: bool = False

    def __repr__(self):
        rows = max(map(len, self.table.values()), default=0)
        return f"<{self.type} in {self.folder}: {self.summary.get('status', 'not finished')}, {rows} rows; {', '.join(self.headlines)}>"

    @property
    def name(self):
        return self.folder.resolve().name

    @property
    def type(self):
        """Returns the type of the analysis, the value of Analysis/Type."""
        return self.parameter("Analysis", "Type")

    @property
    def units(self):
        return {name: getattr(column, "unit", "1") for name, column in self.table.items()}

    @property
    def headlines(self):
        """{entry: Number} of the summary that say most, in the order in which the run tells them: those that `!` marks on its page, and
        those that the scene asks for by name."""
        return {name: value for name, value in self.summary.items() if isinstance(value, Number) and np.isfinite(value) and "headline" in value.more}

    def has(self, column):
        """Tells if a column exists and holds at least one number."""
        return column in self.table and bool(np.isfinite(self.table[column]).any())

    @cached_property
    def _parsed_parameters(self):
        return parse(self.parameters)

    def parameter(self, section, name):
        """The text of a parameter as used; KeyError if there is none."""
        return self._parsed_parameters[f"{section}/{name}"].text

    @cached_property
    def ways(self):
        """Returns the direction of each row, 1 forward or -1 backward; a turning point belongs to the stroke that led to it."""
        steps = np.sign(np.diff(self.table["x"], prepend=self.table["x"][:1]))
        moving = np.flatnonzero(steps)
        if len(moving) == 0:
            return np.ones(len(steps), dtype=int)
        last = np.maximum(np.searchsorted(moving, np.arange(len(steps)), side="right") - 1, 0)
        return steps[moving[last]].astype(int)

    def face(self, x: float, way: Optional[str] = None) -> FaceState:
        """The FaceState nearest to an x [mm] of the drive, of "forward" or "backward" motion if one is named. Throws NotAResult, also
        where the drive does not come to x, and ValueError for other words."""
        if way not in (None, *WAYS):
            raise ValueError(f'no way {way}; there are {", ".join(WAYS)}')
        face = self.friction_face
        if face is None or len(face.time) == 0:
            raise NotAResult(f"{self.folder}: no friction face in it: its model has none")
        steps = np.arange(len(face.time))
        if way is not None:
            steps = steps[self.ways[face.find_rows(self.table["time"])] == WAYS[way]]
        if len(steps) == 0:
            raise NotAResult(f"{self.folder}: no {way} motion in it")
        if not face.x.min() - 1e-9 <= x <= face.x.max() + 1e-9:
            raise NotAResult(f"{self.folder}: x from {face.x.min():.4g} to {face.x.max():.4g} mm, not {x:.4g}")
        step = int(steps[np.abs(face.x[steps] - x).argmin()])
        return FaceState(float(face.time[step]), float(face.x[step]), face.xi, face.zeta, face.pressure[step], face.traction[step])

    @property
    def frames(self):
        """[(time [s], file)] of the fields that were written, in order."""
        return indexed(self.folder)

    def fields(self, number: int) -> dict[str, Column]:
        """{name: Column} of the frame of that number, from 0: nodes and cells of the mesh, displacement, stress. Throws NotAResult."""
        try:
            return read_fields(self.folder, self.frames[number][1])
        except IndexError:
            raise NotAResult(f"{self.folder}: {len(self.frames)} frames of fields in it, no number {number}") from None

    def columns(self):
        """{name: values} of the table: of a study with words where a parameter has no numbers, and why runs were not completed."""
        texts = self.groups.get("runs", {})
        worded = {name: words for name, words in texts.items() if name not in self.table or not are_numbers(words)}
        return {**self.table, **worded}

    def to_pandas(self):
        """The table as a pandas.DataFrame; its attrs["units"] has the units."""
        import pandas  # type: ignore[import]

        frame = pandas.DataFrame({name: np.asarray(values) for name, values in self.columns().items()})
        frame.attrs["units"] = self.units
        return frame


def are_numbers(texts):
    try:
        return bool(np.isfinite(np.asarray(texts).astype(float)).all())
    except ValueError:
        return False


def open_result(path, attempts=5):
    """The open h5py.File; swmr=True where a run still writes it or was killed."""
    for attempt in range(attempts):
        for arguments in ({}, {"swmr": True}):
            try:
                return h5py.File(path, "r", **arguments)
            except OSError as error:
                reason = error
        if not h5py.is_hdf5(path):
            break
        time.sleep(0.2)  # between the last row and the summary the file is shut for a moment
    raise NotAResult(f"{path}: cannot be read as HDF5 ({reason})")


def read_result(folder: Union[str, PathLike]) -> Result:
    """The Result in a folder. Throws NotAResult."""
    folder = Path(folder)
    path = folder / "result.h5"
    for what in ("map", "study"):
        if not path.is_file() and (folder / f"{what}.journal").is_file():
            raise NotAResult(f"{folder}: a {what} that was cut short or goes on; where it was cut short, the same command takes it up")
    if not path.is_file():
        raise NotAResult(f"{folder}: no result.h5 there")
    with open_result(path) as file:
        if file.attrs.get("format") != "sprag result" or "table" not in file:
            raise NotAResult(f"{path}: not a result of sprag")
        result = Result(
            folder=folder,
            table=_equally_long(_entries(file["table"])),
            parameters=file["parameters"].asstr()[()],
            finished="summary" in file,
        )
        if result.finished:
            result.summary = _entries(file["summary"])
            result.meta = _entries(file["meta"])
            result.groups = {n: _entries(g) for n, g in file.items() if isinstance(g, h5py.Group) and n not in KNOWN}
        if "face" in file:
            result.friction_face = _read_face(path, file["face"])
        return result


def _read_face(path, group):
    length = min(len(group[name]) for name in ("time", "x", "pressure", "traction"))
    order = np.argsort(group["xi"][:])
    return Face(
        xi=_value(group["xi"])[order],
        weight=_value(group["weight"])[order],
        time=_value(group["time"])[:length],
        x=_value(group["x"])[:length],
        pressure=Rows(path, "pressure", length, order),
        traction=Rows(path, "traction", length, order),
        zeta=_value(group["zeta"])[order] if "zeta" in group else None,
    )


def _equally_long(arrays):
    """A run killed between two columns leaves a last row that is not complete."""
    length = min((len(values) for values in arrays.values()), default=0)
    return {name: values[:length] for name, values in arrays.items()}


def _entries(group):
    return {name: _value(data) for name, data in group.items()}


def _value(data):
    return described(data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()], data.attrs)


def indexed(folder, name="fields"):
    """[(time [s], file)] of the frames written so far, in order."""
    index = Path(folder) / f"{name}.xdmf"
    if not index.is_file():
        return []
    found = re.findall(r'<Time Value="([^"]+)".*?>([^<>\s]+-\d+\.h5):/', index.read_text(encoding="utf-8"), re.DOTALL)
    return [(float(time), index.parent / file) for time, file in found]


def read_fields(folder, path=None, group="fields", names=None):
    """{name: Column} of the mesh and, if a path is given, of the frame in it; group "fields" or "face"; all names unless some are given.
    Throws NotAResult."""
    found, mesh = {}, Path(folder) / "fields-mesh.h5"
    for part in (mesh, path) if path else (mesh,):
        try:
            with h5py.File(part, "r") as file:
                found.update({name: _value(data) for name, data in file[group].items() if names is None or name in names})
        except (OSError, KeyError, ValueError) as error:
            raise NotAResult(f"{part}: cannot be read as fields of this version of sprag ({error})") from error
    return found
