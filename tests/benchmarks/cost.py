#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what model A costs, both strokes: CPU time by phase over face size and degree, and ratios between methods. Run it on a
machine that does nothing else; see without-inertia.md."""

import argparse
import resource
import sys
import tempfile
from pathlib import Path

import h5py
from runs import add_program, print_row, run_scene

PHASES = ("mesh", "model", "steps_and_output", "output")
COLUMNS = ("run", "DOF", *PHASES, "in all", "process", "steps", "iterations", "MiB", "ratio")
WIDTHS = (36, 8, 7, 7, 18, 8, 8, 9, 7, 12, 6, 0)

FINITE_STRAIN = {"Analysis/Step": 10, "Analysis/Plane": "strain", "Lever/Material": "neo-Hookean"}
LINEAR_STRAIN = {"Analysis/Step": 10, "Analysis/Plane": "strain"}

# name, changes to the scene, name of the run that the ratio of CPU times is to
RUNS = (
    ("degree 2, face size 1", {"Mesh/Face size": 1}, "degree 2, face size 0.5"),
    ("degree 2, face size 0.5", {}, "degree 2, face size 0.5"),
    ("degree 2, face size 0.25", {"Mesh/Face size": 0.25}, "degree 2, face size 0.5"),
    ("degree 2, face size 0.125", {"Mesh/Face size": 0.125}, "degree 2, face size 0.5"),
    ("degree 1, face size 0.5", {"Mesh/Degree": 1}, "degree 2, face size 0.5"),
    ("augmented Lagrangian", {"Contact/Enforcement": "augmented Lagrangian"}, "degree 2, face size 0.5"),
    ("factorise once, step 5", {"Analysis/Step": 5}, "factorise once, step 5"),
    ("general path, step 5", {"Analysis/Step": 5, "Analysis/Solution": "general"}, "factorise once, step 5"),
    ("plane strain, linear, step 10", LINEAR_STRAIN, "plane strain, linear, step 10"),
    ("plane strain, neo-Hookean, step 10", FINITE_STRAIN, "plane strain, linear, step 10"),
)


def children_cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(sprag, changes, output):
    """{column: number} of one run; its message where it failed."""
    before = children_cpu()
    try:
        run_scene(sprag, "model-a.prm", {"Output/Fields": "turning points", "Mesh/Face size": 0.5, **changes}, output)
    except RuntimeError as failure:
        return str(failure)
    process = children_cpu() - before
    with h5py.File(output / "result.h5", "r") as file:
        meta, summary = file["meta"], file["summary"]
        cost = {phase: meta[f"cpu_time_{phase}"][()] for phase in PHASES}
        cost["DOF"] = meta["degrees_of_freedom"][()]
        cost["in all"] = meta["cpu_time"][()]
        cost["MiB"] = meta["peak_memory"][()]
        cost["steps"] = summary["steps"][()]
        cost["iterations"] = summary["iterations"][()]
    return {**cost, "process": process}


def text(column, cost):
    whole = column in ("DOF", "steps", "iterations", "MiB")
    return f"{cost[column]:.0f}" if whole else f"{cost[column]:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--only", default="", help="runs whose name contains this text, and what they are compared with")
    options = parser.parse_args()

    chosen = [entry for entry in RUNS if options.only in entry[0]]
    needed = {name for entry in chosen for name in (entry[0], entry[2])}
    runs = [entry for entry in RUNS if entry[0] in needed]
    costs = {}
    with tempfile.TemporaryDirectory(prefix="sprag-cost-") as folder:
        for name, changes, _ in runs:
            print(f"... {name}", file=sys.stderr)
            cost = run(options.sprag.resolve(), changes, Path(folder) / str(len(costs)))
            if isinstance(cost, str):
                print(f"{name}: {cost}", file=sys.stderr)
            else:
                costs[name] = cost
    print_row([{"steps_and_output": "steps and output"}.get(column, column) for column in COLUMNS], WIDTHS)
    for name, _, reference in runs:
        if name in costs and reference in costs:
            ratio = costs[name]["process"] / costs[reference]["process"]
            print_row([name, *(text(column, costs[name]) for column in COLUMNS[1:-1]), f"{ratio:.2f} of '{reference}'"], WIDTHS)
    return 0 if len(costs) == len(runs) else 1


if __name__ == "__main__":
    sys.exit(main())
