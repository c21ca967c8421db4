# SPDX-License-Identifier: GPL-3.0-only
"""Runs at the extremes of the parameters: each meets the accuracy it tells, tells by a warning that it does not, or stops with a
message that names limit and parameter. A row is a run; its reference comes from elsewhere: formulas, laws of scale, other steps or
meshes. Exits 1 where one falls short. Environment: SPRAG, the program, and SPRAG_SOURCE, the sources.

    /usr/bin/python3 extremes.py           # what answers within seconds
    /usr/bin/python3 extremes.py --slow    # dear ones alone
    /usr/bin/python3 extremes.py --only mu # rows with this in their name
    /usr/bin/python3 extremes.py --write   # all, and their table into extremes.csv
"""

import argparse
import csv
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from extreme_rows import ROWS  # noqa: E402
from extreme_runs import Run  # noqa: E402
from runs import SOURCE, SPRAG  # noqa: E402

HEADER = ("extreme", "outcome", "steps", "iterations a step", "rejected", "error", "admitted", "against", "warnings")


class Runner:
    """Makes each run once; references are shared by rows."""

    def __init__(self, folder):
        self.folder = folder
        self.made = {}
        self.lock = threading.Lock()

    def run(self, scene, options, timeout):
        key = (scene, tuple(options))
        with self.lock:
            mine = key not in self.made
            made = self.made.setdefault(key, Future())
            output = self.folder / str(len(self.made))
        if mine:
            try:
                made.set_result(self.make(scene, options, timeout, output))
            except Exception as error:
                made.set_exception(error)
        return made.result()

    @staticmethod
    def make(scene, options, timeout, output):
        command = [SPRAG, SOURCE / "params" / f"{scene}.prm", "--output", output]
        command += [word for option in ("Output/Fields=none", *options) for word in ("--set", option)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=timeout, stdin=subprocess.DEVNULL)
        return Run(done.returncode, done.stderr, output / "result.h5")


def judged(runner, row):
    """Returns the row of the table and the faults."""
    try:
        run = runner.run(row.scene, row.options, row.timeout)
    except subprocess.TimeoutExpired:
        return (row.name, "hangs"), [f"no end within {row.timeout} s"]
    faults = run.values_that_are_no_numbers()
    if run.status != row.status:
        faults.append(f"exit status {run.status}, not {row.status}: {run.message}")
    for words in row.says:
        if words not in run.message:
            faults.append(f"the message lacks '{words}': {run.message}")
    missing = [name for name in row.warns if name not in run.warnings]
    if missing:
        faults.append(f"no warning {', '.join(missing)}, but {run.warnings}")
    faults += [f"warning {name}" for name in row.forbids if name in run.warnings]
    error = admitted = None
    if row.check and run.status == 0:
        error, admitted = row.check(run, lambda *other: runner.run(row.find_scene(*other), row.find_options(*other), row.timeout))
        if row.limit is not None:
            admitted = row.limit
        if not error <= admitted:
            faults.append(f"error {error:.2g} of {row.against}, admitted {admitted:.2g}")
    return cells(row, run, error, admitted), faults


def cells(row, run, error, admitted):
    outcome = {0: "completed", 1: "stops", 2: "refused"}.get(run.status, f"exit status {run.status}")
    if run.status:
        outcome += ": " + run.reason

    def number(value, form="{:.2g}"):
        return "" if value is None else form.format(value)

    steps, iterations = run.count("steps"), run.count("iterations")
    each = iterations / steps if steps and iterations is not None else None
    estimate = number(admitted) + ("" if admitted is None or row.limit is not None else " told")
    rejected = number(run.count("rejected_steps"), "{:.0f}")
    warnings = ", ".join(f"`{name}`" for name in run.warnings)
    return (row.name, outcome, number(steps, "{:.0f}"), number(each, "{:.1f}"), rejected, number(error), estimate, row.against, warnings)


def write(lines):
    with open(SOURCE / "tests/robustness/extremes.csv", "w", encoding="utf-8", newline="") as table:
        csv.writer(table, lineterminator="\n").writerows((HEADER, *lines))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--slow", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    rows = [row for row in ROWS if arguments.write or row.slow == arguments.slow]
    rows = [row for row in rows if re.search(arguments.only, row.name)]
    lines, short = [], 0
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        runner = Runner(Path(folder))
        for row, (line, faults) in zip(rows, pool.map(lambda row: judged(runner, row), rows)):
            lines.append(line)
            print("| " + " | ".join(line) + " |", flush=True)
            for fault in faults:
                print(f"    FALLS SHORT, {row.name}: {fault}", flush=True)
            short += bool(faults)
    cpu = os.times().children_user + os.times().children_system
    print(f"{len(rows)} rows, {short} fall short; {time.monotonic() - begin:.0f} s, {cpu:.0f} CPU s")
    if arguments.write and not arguments.only:
        write(lines)
    return 1 if short else 0


if __name__ == "__main__":
    sys.exit(main())
