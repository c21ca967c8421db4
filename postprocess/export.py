#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Writes results as CSV, which Excel, MATLAB, pandas and numpy open, and their single numbers as JSON too.

Each table becomes a file: table.csv, and of a study, map or held slide also what its result holds beside, such as map.csv or modes.csv.
The header has the units, as in "x [mm]"; a number that there is not leaves its cell empty. summary.csv has a row an entry:
name, value, unit, description. summary.json has summary, accuracy, warnings, meta and parameters.
"""

import csv
import json
import sys
from pathlib import Path

import h5py
import numpy as np

from arguments import add_folders, add_output, make_parser, script
from sprag.parameters import parse
from sprag.results import NotAResult, open_result, read_result

ENTRIES = ("summary", "accuracy", "warnings", "meta")  # groups of single numbers and texts
FORMATS = ("csv", "json")
# Columns that stand before the others.
FIRST = ("time", "x", "first", "second", "direction", "v", "theta", "s", "P", "F", "Q", "mu", "v_rel", "theta_2", "s_2", "P_2", "F_2", "Q_2",
         "frequency", "growth_rate", "xi")  # fmt: skip


# Tables of a result


def read_tables(result):
    """{name: {header: values}} of all but the friction face, columns of one table equally long. Throws NotAResult."""
    tables = {"table": read_columns(result)} if result.table else {}
    with open_result(result.folder / "result.h5") as file:
        if "map" in file:
            axes = {name: file["map"][name].attrs["description"] for name in ("first", "second")}
            tables["table"] = {header(axes.get(name, name), result.units[name]): values for name, values in ordered(result.table).items()}
        for name in sorted(set(file) - {"table", "face", "parameters", "runs", *ENTRIES}):
            tables.update(read_group_tables(name, file[name]))
    return tables


def read_columns(result):
    """The table, of a study what was varied first and its words last."""
    columns, texts = result.columns(), result.groups.get("runs", {})
    first = ordered({name: values for name, values in columns.items() if name in result.table}, [name for name in texts if name in result.table])
    return {header(name, getattr(values, "unit", None)): values for name, values in {**first, **columns}.items()}


def ordered(columns, before=()):
    """Returns the columns with the most used ones first and the others by name."""
    first = [name for name in ("run", *before, *FIRST) if name in columns]
    return {name: columns[name] for name in dict.fromkeys([*first, *sorted(columns)])}


def header(name, unit):
    return f"{name} [{unit}]" if unit else name


def read_group_tables(name, group):
    """Numbers of one dimension by their length; those of two over both of their axes, a row a point."""
    if name == "map":
        return {"map": over_axes(group, "first", "second", {n: d for n, d in group.items() if d.ndim == 2})}
    by_length = {}
    for column, data in ordered(group).items():
        if data.ndim == 1:
            by_length.setdefault(len(data), {})[header(column, data.attrs.get("unit"))] = read_values(data)
    if name == "modes":
        return split_mode_tables(group, by_length)
    widest_first = sorted(by_length.items(), key=lambda item: -len(item[1]))
    return {name if i == 0 else f"{name}-{next(iter(columns)).split()[0]}": columns for i, (_, columns) in enumerate(widest_first)}


def split_mode_tables(group, by_length):
    number = len(group["frequency"])
    numbered = {"mode [1]": np.arange(1, number + 1), **{k: v for k, v in by_length.get(number, {}).items() if k != "xi [mm]"}}
    shapes = {name: data for name, data in group.items() if data.ndim == 2}
    if not shapes or "xi" not in group:
        return {"modes": numbered}
    mode, xi = np.meshgrid(np.arange(1, number + 1), group["xi"][:], indexing="ij")
    flat = {header(name, data.attrs.get("unit")): data[:].ravel() for name, data in shapes.items()}
    return {"modes": numbered, "mode-shapes": {"mode [1]": mode.ravel(), "xi [mm]": xi.ravel(), **flat}}


def over_axes(group, first, second, grids):
    """The axes bear the names of the parameters that they stand for."""
    axes = [group[name] for name in (first, second)]
    places = np.meshgrid(*(axis[:] for axis in axes), indexing="ij")
    named = {header(axis.attrs["description"], axis.attrs["unit"]): place.ravel() for axis, place in zip(axes, places)}
    return {**named, **{header(name, data.attrs.get("unit")): data[:].ravel() for name, data in grids.items()}}


def read_face(result):
    """Pressure and traction, a row for each point under pressure at each step that was written."""
    face = result.friction_face
    if face is None:
        raise NotAResult(f"{result.folder}: no friction face in it")
    pressure, traction = np.asarray(face.pressure), np.asarray(face.traction)
    steps, points = np.nonzero(pressure > 0)
    named = {"time": face.time[steps], "x": face.x[steps], "xi": face.xi[points]}
    named.update(pressure=pressure[steps, points], traction=traction[steps, points])
    return {header(name, getattr(values, "unit", "MPa")): values for name, values in named.items()}


def read_values(data):
    return data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:]


def read_entries(result):
    """{group: {name: {value, unit, description, ...}}} of single numbers and texts, and the parameters."""
    found = {}
    with open_result(result.folder / "result.h5") as file:
        for group in (name for name in ENTRIES if name in file):
            found[group] = {name: read_entry(data) for name, data in file[group].items()}
    parameters = parse(result.parameters)
    found["parameters"] = {name: {"value": plain(p.number if p.number is not None else p.text), "unit": p.unit} for name, p in parameters.items()}
    return found


def read_entry(data):
    value = data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()]
    return {"value": plain(value), **{name: plain(text) for name, text in data.attrs.items()}}


def plain(value):
    """Returns a value for JSON, which knows neither NaN nor infinity."""
    if isinstance(value, np.ndarray):
        return [plain(each) for each in value.tolist()]
    value = value.item() if isinstance(value, np.generic) else value
    return None if isinstance(value, float) and not np.isfinite(value) else value


# Into files


def cell(value, comma):
    """Numbers with all their digits."""
    if value is None or (isinstance(value, (float, np.floating)) and np.isnan(value)):
        return ""
    if isinstance(value, (float, np.floating)):
        text = repr(float(value) + 0.0)  # no -0
        text = text[:-2] if text.endswith(".0") else text
        return text.replace(".", ",") if comma else text
    return value


def write_csv(path, names, rows, comma):
    """With a decimal comma the cells are separated by semicolons, as Excel has it where commas are decimal."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, delimiter=";" if comma else ",")
        writer.writerow(names)
        writer.writerows([cell(value, comma) for value in row] for row in rows)
    print(path)


def export(result, folder, formats, only, comma):
    """Throws NotAResult where something asked for is not there."""
    entries = read_entries(result)
    tables = read_tables(result)
    if only and "face" in only:
        tables["face"] = read_face(result)
    names = [*tables, *(["summary"] if "summary" in entries else [])]
    unknown = [name for name in only or () if name not in names]
    if unknown:
        raise NotAResult(f"{result.folder}: no {', '.join(unknown)} in it; there are {', '.join([*names, 'face'] if result.friction_face else names)}")
    folder.mkdir(parents=True, exist_ok=True)
    chosen = only or names
    if "csv" in formats:
        for name in (name for name in chosen if name in tables):
            write_csv(folder / f"{name}.csv", list(tables[name]), zip(*tables[name].values()), comma)
        if "summary" in chosen:
            rows = [(name, entry["value"], entry.get("unit", ""), entry.get("description", "")) for name, entry in entries["summary"].items()]
            write_csv(folder / "summary.csv", ("name", "value", "unit", "description"), rows, comma)
    if "json" in formats:
        path = folder / "summary.json"
        path.write_text(json.dumps(entries, indent=2, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
        print(path)


@script
def main(arguments=None):
    parser = make_parser(__doc__)
    add_folders(parser)
    add_output(parser, "FOLDER", "the result's; of several results one folder each in it", FORMATS, "csv,json")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="as table, summary, map, modes; face has the pressure and comes if named")
    parser.add_argument("--decimal-comma", action="store_true", help="1,5 instead of 1.5, and semicolons between cells")
    options = parser.parse_args(arguments)
    for folder in options.folders:
        result = read_result(folder)
        target = options.output or folder
        if options.output and len(options.folders) > 1:
            target = options.output / result.name
        export(result, target, options.format or FORMATS, options.only, options.decimal_comma)


if __name__ == "__main__":
    sys.exit(main())
