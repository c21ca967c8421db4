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

sys.path.insert(0, str(Path(__file__).resolve().parent / "support"))
from runs import SOURCE, sprag  # noqa: E402

LIST = SOURCE / "tests" / "pages.toml"
LONGEST = 3600  # seconds of a run


def page_text(page):
    """The page in one line, so that breaks of lines do not matter."""
    return " ".join((SOURCE / page).read_text(encoding="utf-8").split())


def find_zeros(values, places):
    """Places at which values change their sign, by lines between them."""
    pairs = zip(values, values[1:], places, places[1:])
    return [float(x + (y - x) * a / (a - b)) for a, b, x, y in pairs if a * b < 0]


def read_value(result, name):
    """The entry of /summary, or of the group that the name begins with; NAME[ROW] is a value of /table, `zero of A over B` where A
    changes its sign over the parameter B of a study."""
    with h5py.File(result) as file:
        if zero := re.fullmatch(r"zero of (\w+) over (\w+)", name):
            return find_zeros(*(file["table/" + column][:] for column in zero.groups()))
        if row := re.fullmatch(r"(.+)\[(\d+)\]", name):
            return float(file["table/" + row[1]][int(row[2])])
        value = file[name if "/" in name else "summary/" + name][()]
    return value.decode() if isinstance(value, bytes) else float(value)


def last_digit(printed):
    """The value of one in the last digit."""
    mantissa, _, exponent = printed.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def find_problem(entry, printed, name, results):
    """Returns the problem of a printed number, or None. `against` asks for the difference of two runs in per cent."""
    value = read_value(results[entry["command"]], name)
    if isinstance(value, list):
        value = min(value, key=lambda zero: abs(entry.get("times", 1) * zero - float(printed)), default=float("nan"))
    if isinstance(value, str):
        return None if value == printed else f"the run says {value}"
    if "against" in entry:
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


def run(command, folder):
    """The result of a command line, whose first word is a scene of params/."""
    scene, *options = shlex.split(command)
    done = sprag(SOURCE / "params" / scene, *options, "--output", folder, "--overwrite", timeout=LONGEST)
    if done.returncode != 0:
        raise SystemExit(f"{command}\n{done.stderr}")
    return folder / "result.h5"


def read_entries(thorough, page):
    """The numbers to compare, each with the command of its run."""
    for listed_run in tomllib.loads(LIST.read_text(encoding="utf-8"))["run"]:
        if thorough or listed_run.get("quick", False):
            for number in listed_run["numbers"]:
                if page in number["page"]:
                    yield {"command": listed_run["command"], **number}


def compare(thorough, page):
    entries = list(read_entries(thorough, page))
    commands = sorted({entry[key] for entry in entries for key in ("command", "against") if key in entry})
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor() as pool:
        files = pool.map(lambda job: run(job[1], Path(folder) / str(job[0])), enumerate(commands))
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
