#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what stability maps cost: seconds and cells of a 60 x 60 map over friction and lever depth, beam and condensed model,
refined near the boundaries and every cell. Run it on a machine that does nothing else; see in-time.md."""

import argparse
import sys
import tempfile
from pathlib import Path

import h5py
from runs import add_program, print_row, run_scene

SCENE = "map-friction-depth-a.prm"
COLUMNS = ("map", "processes", "grid cells", "judged on grid", "in all", "wall [s]", "CPU [s]", "CPU/cell [ms]", "ratio")
WIDTHS = (28, 11, 12, 16, 8, 10, 9, 15, 8)

# name, changes to the scene, name of the run that the ratio of wall times is to
RUNS = (
    ("beam, every cell", {"Map/Coarsest": 1, "Map/Bisections": 0}, "beam, every cell"),
    ("beam, refined", {}, "beam, every cell"),
    ("condensed, every cell", {"Analysis/Model": "condensed", "Map/Coarsest": 1, "Map/Bisections": 0}, "condensed, every cell"),
    ("condensed, refined", {"Analysis/Model": "condensed"}, "condensed, every cell"),
)


def run(options, changes, output):
    """{column: number} of one map; its message where it failed."""
    grid = {"Map/First points": options.points, "Map/Second points": options.points}
    jobs = ("--jobs", options.jobs) if options.jobs else ()
    try:
        run_scene(options.sprag, SCENE, {**grid, **changes}, output, *jobs)
    except RuntimeError as failure:
        return str(failure)
    with h5py.File(output / "result.h5", "r") as file:
        meta, summary = file["meta"], file["summary"]
        cells = summary["cells_judged"][()]
        return {
            "processes": meta["ranks"][()],
            "grid cells": summary["grid_points"][()],
            "judged on grid": summary["grid_cells_judged"][()],
            "in all": cells,
            "wall [s]": meta["wall_time"][()],
            "CPU [s]": meta["cpu_time_all"][()],
            "CPU/cell [ms]": 1000 * meta["cpu_time_all"][()] / cells,
        }


def text(column, cost):
    return f"{cost[column]:.1f}" if "[" in column else f"{cost[column]:.0f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--only", default="", help="maps whose name contains this text")
    parser.add_argument("--points", type=int, default=60, help="of the grid, each way")
    parser.add_argument("--jobs", type=int, help="processes; default: one a core")
    options = parser.parse_args()

    chosen = [entry for entry in RUNS if options.only in entry[0]]
    costs = {}
    print_row(COLUMNS, WIDTHS)
    with tempfile.TemporaryDirectory(prefix="sprag-map-") as folder:
        for number, (name, changes, reference) in enumerate(chosen):
            cost = run(options, changes, Path(folder) / str(number))
            if isinstance(cost, str):
                print(f"{name}: {cost}", file=sys.stderr)
                continue
            costs[name] = cost
            ratio = f"{cost['wall [s]'] / costs[reference]['wall [s]']:.2f}" if reference in costs else ""
            print_row([name, *(text(column, cost) for column in COLUMNS[1:-1]), ratio], WIDTHS)
    return 0 if len(costs) == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
