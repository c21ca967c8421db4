# SPDX-License-Identifier: GPL-3.0-only
"""Reads result.h5 as written by sprag, finished or not."""

from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
import re
import sys
import time
import traceback
from typing import Optional

import h5py
import numpy as np
from parameters import value_of_text


KNOWN = ("table", "face", "summary", "meta")


class NotAResult(Exception):
    """The folder holds no result of sprag; the text says which and why."""


def script(main):
    """The exit code of what a script does: 0, or 2 with one line on stderr where a result or file cannot be read or written. What a
    damaged result lacks shows anywhere, by any exception: the line tells what was read and where it failed."""

    name = Path(main.__code__.co_filename).name

    @wraps(main)
    def with_exit_code(arguments=None):
        try:
            main(arguments)
        except (NotAResult, OSError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            return 2
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            what = f"{type(error).__name__}: {error}".splitlines()[0]
            where = f"{Path(place.filename).name}, line {place.lineno}"
            given = ", ".join(word for word in map(str, arguments or sys.argv[1:]) if Path(word).exists())
            print(f"{name}: {given}: a result is damaged or of another version of sprag: {what} ({where})", file=sys.stderr)
            return 2
        return 0

    return with_exit_code


class Rows:
    """A quantity of the friction face [written steps x points]: rows[step] reads that step, numpy.asarray(rows) all of them."""

    def __init__(self, path, name, steps, order):
        self.path, self.name, self.steps, self.order = path, name, steps, order

    def __getitem__(self, step):
        with open_result(self.path) as file:
            return file["face"][self.name][range(self.steps)[step]][self.order]

    def __array__(self, dtype=None):
        with open_result(self.path) as file:
            return file["face"][self.name][: self.steps][:, self.order].astype(dtype or float)


@dataclass
class Face:
    """The friction face at the steps that were written."""

    xi: np.ndarray  # of the points [mm]
    weight: np.ndarray  # area of each [mm^2]
    time: np.ndarray  # of the steps [s]
    x: np.ndarray  # of the cylinder at these steps [mm]
    pressure: Rows  # [MPa]
    traction: Rows  # of friction [MPa]
    units: dict
    zeta: Optional[np.ndarray] = None  # across the width, in three dimensions


@dataclass
class Result:
    """One result folder."""

    folder: Path
    table: dict  # column -> array, all equally long
    units: dict  # column -> unit
    descriptions: dict  # column -> meaning
    parameters: str
    summary: dict = field(default_factory=dict)  # empty while the run goes on
    meta: dict = field(default_factory=dict)
    entry_units: dict = field(default_factory=dict)  # of summary and meta
    face: Optional[Face] = None
    groups: dict = field(default_factory=dict)  # other groups: name -> {dataset -> array}
    finished: bool = False

    @property
    def name(self):
        return self.folder.resolve().name

    @property
    def type(self):
        """Of the analysis, as Analysis/Type has it."""
        return self.parameter("Analysis", "Type")

    def has(self, column):
        """Whether a column is there and holds at least one number."""
        return column in self.table and bool(np.isfinite(self.table[column]).any())

    def parameter(self, section, name):
        """The text of a parameter as used; KeyError if there is none."""
        found = re.search(
            rf"^subsection {re.escape(section)}\n(?:(?!end$).*\n)*?\s*set {re.escape(name)}\s*=([^#\n]*)",
            self.parameters,
            re.MULTILINE,
        )
        if not found:
            raise KeyError(f"{section}/{name}")
        return value_of_text(found.group(1))


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


def read_result(folder):
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
        table = _equally_long({name: data[:] for name, data in file["table"].items()})
        result = Result(
            folder=folder,
            table=table,
            units=_attributes(file["table"], "unit"),
            descriptions=_attributes(file["table"], "description"),
            parameters=file["parameters"].asstr()[()],
            finished="summary" in file,
        )
        if result.finished:
            result.summary = _entries(file["summary"])
            result.meta = _entries(file["meta"])
            result.groups = {n: _entries(g) for n, g in file.items() if isinstance(g, h5py.Group) and n not in KNOWN}
            result.entry_units = {**_attributes(file["summary"], "unit"), **_attributes(file["meta"], "unit")}
        if "face" in file:
            result.face = _read_face(path, file["face"])
        return result


def _read_face(path, group):
    length = min(len(group[name]) for name in ("time", "x", "pressure", "traction"))
    order = np.argsort(group["xi"][:])
    return Face(
        xi=group["xi"][:][order],
        weight=group["weight"][:][order],
        time=group["time"][:length],
        x=group["x"][:length],
        pressure=Rows(path, "pressure", length, order),
        traction=Rows(path, "traction", length, order),
        units=_attributes(group, "unit"),
        zeta=group["zeta"][:][order] if "zeta" in group else None,
    )


def _equally_long(arrays):
    """A run killed between two columns leaves a last row that is not complete."""
    length = min((len(values) for values in arrays.values()), default=0)
    return {name: values[:length] for name, values in arrays.items()}


def _attributes(group, attribute):
    return {name: data.attrs.get(attribute, "") for name, data in group.items()}


def _entries(group):
    return {name: _value(data) for name, data in group.items()}


def _value(data):
    return data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()]
