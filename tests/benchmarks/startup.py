#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what a start costs: CPU seconds of a look at the version, closed forms, a beam and model A, what of them is the loading of shared
libraries, and ratios to an earlier build. Run it on a machine that does nothing else; see README.md."""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
from runs import ROOT, add_program, print_row

COLUMNS = ("run", "CPU ms", "user", "system", "libraries", "phases", "rest", "ratio")
WIDTHS = (34, 9, 7, 9, 12, 9, 7, 8)
OUTER_PHASES = ("mesh", "basis", "model", "eigenvalues", "steps_and_output", "fields", "accuracy")

# name, scene of params/ or none, options
RUNS = (
    ("version", None, ("--version",)),
    ("check of model A's mesh", "model-a", ("--validate",)),
    ("closed form", "closed-form-a", ()),
    ("slope", "fig10", ()),
    ("rigid lever in time", "reversal-a", ("--set", "Analysis/Model=rigid")),
    ("beam in time", "reversal-a", ()),
    ("model A, 3 mm of its stroke", "model-a", ("--set", "Drive/Stroke=3", "--set", "Output/Fields=none")),
    ("model A", "model-a", ()),
)


def make_command(program, scene, options, output):
    named = [] if scene is None else [ROOT / "params" / f"{scene}.prm", "--output", output, "--overwrite", "--quiet"]
    return [str(word) for word in [Path(program).resolve(), *named, *options]]


def measure_cpu(command):
    """User and system seconds of a command with all that it starts; RuntimeError if it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "OMP_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {done.stderr.strip()}")
    return after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime


def fastest(commands, rounds):
    """The least of each, taken in turn."""
    times = [[measure_cpu(command) for command in commands] for _ in range(rounds)]
    return [min(column, key=sum) for column in zip(*times)]


def loaded_libraries(command):
    """Counts the libraries that the loader initialised; after an exec they count again."""
    with tempfile.TemporaryDirectory(prefix="sprag-loader-") as folder:
        environment = {**os.environ, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": f"{folder}/of"}
        subprocess.run(command, capture_output=True, check=False, env=environment)
        logs = [path.read_text(errors="replace") for path in Path(folder).iterdir()]
    return sum(log.count("calling init: ") for log in logs)


def phase_seconds(output):
    try:
        with h5py.File(output / "result.h5", "r") as file:
            return sum(file["meta"][name][()] for name in map("cpu_time_{}".format, OUTER_PHASES) if name in file["meta"])
    except OSError:
        return 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--before", type=Path, help="an earlier build, to which the ratios are")
    parser.add_argument("--only", default="", help="runs whose name contains this text")
    parser.add_argument("--rounds", type=int, default=9, help="runs of each, in turn, of which the fastest counts")
    options = parser.parse_args()
    print_row(COLUMNS, WIDTHS)
    with tempfile.TemporaryDirectory(prefix="sprag-startup-") as folder:
        for name, scene, arguments in (run for run in RUNS if options.only in run[0]):
            output = Path(folder) / name.replace(" ", "-")
            programs = [options.sprag] + ([options.before] if options.before else [])
            # The program itself comes last, so that its result is the one that is left.
            commands = [make_command(program, scene, arguments, output) for program in reversed(programs)]
            *before, (user, system) = fastest(commands, options.rounds)
            phases = phase_seconds(output)
            milliseconds = [1000 * time for time in (user + system, user, system)]
            rest = milliseconds[0] - 1000 * phases
            cells = [*milliseconds, loaded_libraries(commands[-1]), 1000 * phases, rest]
            ratio = f"{sum(before[0]) / (user + system):.2f}" if before else ""
            print_row([name, *(f"{cell:.0f}" for cell in cells), ratio], WIDTHS)


if __name__ == "__main__":
    sys.exit(main())
