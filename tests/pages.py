#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-only
"""Compares the numbers that pages print with those of the program; see pages.toml. Environment: SPRAG, the program, and SPRAG_SOURCE,
the sources.

  tests/pages.py               # the quick runs
  tests/pages.py --thorough    # all runs
  tests/pages.py --page time   # those of pages with this in their path
"""

import argparse
import re
import shlex
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "support"))
from runs import SOURCE, sprag  # noqa: E402

LIST = SOURCE / "tests" / "pages.toml"
LONGEST = 3600  # seconds of a run
PRINTED = "printed.txt"  # output and messages of a run, in its folder


def page_text(page):
    """The page in one line, so that breaks of lines do not matter."""
    return " ".join((SOURCE / page).read_text(encoding="utf-8").split())


def find_zeros(values, places):
    """Places at which values change their sign, by lines between them."""
    pairs = zip(values, values[1:], places, places[1:])
    return [float(x + (y - x) * a / (a - b)) for a, b, x, y in pairs if a * b < 0]


def read_files(folder, pattern, unit):
    """The number of files with this pattern in a folder, or their size in MB."""
    sizes = [path.stat().st_size for path in folder.glob(pattern)]
    return len(sizes) if unit == "number" else sum(sizes) / 1e6


def read_number(text):
    """The number that a text is, or the text."""
    return float(text) if re.fullmatch(r"[-+]?[.\d]+(e[-+]?\d+)?", text) else text


def read_entry(value):
    return value.decode() if isinstance(value, bytes) else float(value)


def read_printed(folder, pattern):
    """The group of a regular expression that the output of a run meets once."""
    found = re.findall(pattern, (folder / PRINTED).read_text(encoding="utf-8"))
    if len(found) != 1:
        raise KeyError(f"{len(found)} printed places read {pattern!r}")
    return read_number(found[0])


def read_value(result, name):
    """The value of a name in a result, see pages.toml."""
    if printed := re.fullmatch(r"printed (.*)", name):
        return read_printed(result.parent, printed[1])
    if files := re.fullmatch(r"(number|MB) of (\S+)", name):
        return read_files(result.parent, files[2], files[1])
    if found := re.fullmatch(r"(.+) ~ (.+)", name):
        return read_number(re.search(found[2], read_value(result, found[1]))[1])
    with h5py.File(result) as file:
        if zero := re.fullmatch(r"zero of (\w+) over (\w+)", name):
            return find_zeros(*(file["table/" + column][:] for column in zero.groups()))
        if largest := re.fullmatch(r"largest of (\w+)", name):
            return float(np.nanmax(np.abs(file["table/" + largest[1]][:])))
        if row := re.fullmatch(r"(.+)\[(\d+)\]", name):
            return read_entry(file[row[1] if "/" in row[1] else "table/" + row[1]][int(row[2])])
        value = file[name if "/" in name else "summary/" + name][()]
    return read_entry(value)


def read_difference(column, result, reference):
    """The largest difference of a column from that of another run at the same time, in per cent of the latter's peak."""
    with h5py.File(result) as file, h5py.File(reference) as other:
        values, expected = (each["table"] for each in (file, other))
        joined = np.interp(values["time"][:], expected["time"][:], expected[column][:])
        return 100 * float(np.abs(values[column][:] - joined).max() / np.abs(expected[column][:]).max())


def last_digit(printed):
    """The value of one in the last digit."""
    mantissa, _, exponent = printed.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def find_problem(entry, printed, name, results):
    """Returns the problem of a printed number, or None. `against` asks for the difference of two runs in per cent."""
    rows = re.fullmatch(r"rows of (\w+)", name)
    if rows:
        value = read_difference(rows[1], results[entry["command"]], results[entry["against"]])
    else:
        value = read_value(results[entry["command"]], name)
    if isinstance(value, list):
        value = min(value, key=lambda zero: abs(entry.get("times", 1) * zero - float(printed)), default=float("nan"))
    if isinstance(value, str):
        return None if value == printed else f"the run says {value}"
    if "against" in entry and not rows:
        value = 100 * abs(value / read_value(results[entry["against"]], name) - 1)
    value *= entry.get("times", 1)
    printed = printed.replace(" ", "")
    within = entry.get("within", last_digit(printed))
    return None if abs(float(printed) - value) <= within * (1 + 1e-9) else f"the run says {value:.5g}"


def find_problems(entry, results):
    found = list(re.finditer(entry["sentence"], page_text(entry["page"])))
    if len(found) != 1:
        yield f"{entry['page']}: {len(found)} places read {entry['sentence']!r}, not one"
        return
    values = entry["value"] if isinstance(entry["value"], list) else [entry["value"]]
    if len(values) != len(found[0].groups()):
        yield f"{entry['page']}: {entry['sentence']!r} has {len(found[0].groups())} numbers for {len(values)} values"
        return
    for printed, name in zip(found[0].groups(), values):
        try:
            problem = find_problem(entry, printed, name, results)
        except KeyError as error:
            problem = f"the run has no such value: {error}"
        if problem:
            yield f"{entry['page']}: '{found[0][0]}', {name}: {printed}; {problem}"


def run(command, status, folder):
    """The result of a command line, whose first word is a scene of params/; it must end with this exit status."""
    scene, *options = shlex.split(command)
    done = sprag(SOURCE / "params" / scene, *options, "--output", folder, "--overwrite", timeout=LONGEST)
    if done.returncode != status:
        raise SystemExit(f"{command}\n{done.stderr}")
    folder.mkdir(exist_ok=True)  # a validation makes none
    (folder / PRINTED).write_text(done.stdout + done.stderr, encoding="utf-8")
    return folder / "result.h5"


def read_entries(thorough, page):
    """The numbers to compare, each with the command of its run."""
    for listed_run in tomllib.loads(LIST.read_text(encoding="utf-8"))["run"]:
        if thorough or listed_run.get("quick", False):
            for number in listed_run["numbers"]:
                if page in number["page"]:
                    yield {"command": listed_run["command"], "status": listed_run.get("status", 0), **number}


def compare(thorough, page):
    entries = list(read_entries(thorough, page))
    statuses = {entry["command"]: entry["status"] for entry in entries}
    commands = sorted({entry[key] for entry in entries for key in ("command", "against") if key in entry})
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor() as pool:
        files = pool.map(lambda job: run(job[1], statuses.get(job[1], 0), Path(folder) / str(job[0])), enumerate(commands))
        results = dict(zip(commands, files))
        problems = [problem for entry in entries for problem in find_problems(entry, results)]
    count = sum(len(entry["value"]) if isinstance(entry["value"], list) else 1 for entry in entries)
    print("\n".join([*problems, f"{count} numbers of {len(commands)} runs, {len(problems)} stale"]))
    return not problems and bool(entries)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--thorough", action="store_true")
    parser.add_argument("--page", default="")
    options = parser.parse_args()
    return 0 if compare(options.thorough, options.page) else 1


if __name__ == "__main__":
    sys.exit(main())
