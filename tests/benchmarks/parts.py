#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what each part of the apparatus costs: model A without any, and with one at a time, both strokes without inertia and the
reversal in time (condensed), no fields. CPU seconds are the least of several runs. With --before PROGRAM, a build from before
there were such parts, also what model A without them cost there. See parts.md."""

import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, run_scene

PARTS = {
    "none": {},
    "sprung pivot frame": {"Support/Type": "sprung"},
    "leaf spring": {"Rotational spring/Type": "leaf"},
    "lever frame": {"Lever/Outline": "frame"},
    "plate on sensors": {"Friction plate/Type": "on sensors"},
    "elastic cylinder": {"Cylinder/Type": "solid"},
    "second lever": {"Mirrored pair/Type": "full"},
    "all": {
        "Support/Type": "sprung",
        "Rotational spring/Type": "leaf",
        "Lever/Outline": "frame",
        "Friction plate/Type": "on sensors",
        "Cylinder/Type": "solid",
        "Mirrored pair/Type": "full",
    },
}
COLUMNS = ("parts", "DOF", "steps", "iterations", "CPU s", "ratio", "steps in time", "steps/CPU s", "peak P N")
WIDTHS = (20, 8, 7, 12, 8, 8, 15, 13, 10)


def run(sprag, scene, changes, folder):
    run_scene(sprag, scene, {"Output/Fields": "none", **changes}, folder, "--overwrite")
    with h5py.File(Path(folder) / "result.h5", "r") as file:
        meta, summary = file["meta"], file["summary"]
        number = lambda group, name: float(group[name][()]) if name in group else np.nan
        return {
            "dofs": number(meta, "degrees_of_freedom"),
            "steps": number(summary, "steps"),
            "iterations": number(summary, "iterations"),
            "cpu": number(meta, "cpu_time"),
            "rate": number(meta, "steps_per_cpu_second"),
            "P": np.nanmax(file["table/P"][:]),
        }


def best(runs, key, choose):
    return choose(result[key] for result in runs)


def row(name, sprag, changes, repeats, folder, reference):
    statics = [run(sprag, "model-a.prm", changes, folder) for _ in range(repeats)]
    in_time = {**changes, "Analysis/Model": "condensed"}
    dynamics = [run(sprag, "reversal-a.prm", in_time, folder) for _ in range(repeats)]
    cpu = best(statics, "cpu", min)
    cells = (
        name,
        f"{statics[0]['dofs']:.0f}",
        f"{statics[0]['steps']:.0f}",
        f"{statics[0]['iterations']:.0f}",
        f"{cpu:.2f}",
        f"{cpu / (reference or cpu):.2f}",
        f"{dynamics[0]['steps']:.0f}",
        f"{best(dynamics, 'rate', max):.0f}",
        f"{dynamics[0]['P']:.2f}",
    )
    print("".join(cell.rjust(width) for cell, width in zip(cells, WIDTHS)), flush=True)
    return cpu


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--before", type=Path, help="an earlier build, for model A without parts")
    parser.add_argument("--repeats", type=int, default=3, help="runs of which the fastest counts")
    arguments = parser.parse_args()
    print("".join(name.rjust(width) for name, width in zip(COLUMNS, WIDTHS)))
    with tempfile.TemporaryDirectory(prefix="sprag-benchmark-") as folder:
        reference = None
        if arguments.before:
            reference = row("earlier build", arguments.before, {}, arguments.repeats, folder, None)
        for name, changes in PARTS.items():
            cpu = row(name, arguments.sprag, changes, arguments.repeats, folder, reference)
            reference = reference or cpu


if __name__ == "__main__":
    main()
