#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what runs cost, group by group: without inertia, parts of the apparatus, in time, maps, eigenvalues, a table, three dimensions. Ratios are those of CPU
time to the first run of a group. With --growth, how the parts of a run grow with face size, steps, cycles and modes, and the power that theory
expects. Run it on a machine that does nothing else; see without-inertia.md, parts.md and in-time.md."""

import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, print_row, run_scene

COLUMNS = ("run", "DOF", "coordinates", "steps", "iterations", "model s", "steps s", "CPU s", "steps/CPU s", "MiB", "ratio")
WIDTHS = (36, 8, 13, 8, 12, 9, 9, 8, 13, 6, 7)
MODEL, STEPS = ("mesh", "basis", "model"), ("eigenvalues", "steps_and_output", "map")

PARTS = {
    "no part": {},
    "sprung pivot frame": {"Support/Type": "sprung"},
    "leaf spring": {"Rotational spring/Type": "leaf"},
    "lever frame": {"Lever/Outline": "frame"},
    "plate on sensors": {"Friction plate/Type": "on sensors"},
    "elastic cylinder": {"Cylinder/Type": "solid"},
    "second lever": {"Mirrored pair/Type": "full"},
}
PARTS["all parts"] = {name: value for part in PARTS.values() for name, value in part.items()}
ALONE = {"Stability/Critical": "none", "Stability/Roles": "off"}
EVERY_CELL = {"Map/Coarsest": 1, "Map/Bisections": 0}
STRAIN = {"Analysis/Step": 10, "Analysis/Plane": "strain"}
MODELS = ("finite element", "condensed", "beam", "rigid", "closed form")

# Group, scene of params/, {run: changes}.
GROUPS = [
    ("face size", "model-a", {f"face size {size}": {"Mesh/Face size": size} for size in (0.5, 1, 0.25, 0.125)}),
    ("enforcement", "model-a", {name: {"Contact/Enforcement": name} for name in ("augmented Lagrangian", "penalty")}),
    ("solution", "model-a", {"factorise once": {}, "general path": {"Analysis/Solution": "general"}}),
    ("finite strain", "model-a", {"linear": STRAIN, "neo-Hookean": {**STRAIN, "Lever/Material": "neo-Hookean"}}),
    ("parts", "model-a", PARTS),
    ("parts in time", "reversal-a", {name: {"Analysis/Model": "condensed", **part} for name, part in PARTS.items()}),
    ("in time", "reversal-a", {model: {"Analysis/Model": model, "Time/Step": "5e-5"} for model in MODELS}),
    ("map", "map-friction-depth-a", {"beam, every cell": EVERY_CELL, "beam, refined": {}}),
    ("condensed map", "map-friction-depth-a",
     {"every cell": {"Analysis/Model": "condensed", **EVERY_CELL}, "refined": {"Analysis/Model": "condensed"}}),
    ("table", "isolation-ground-a", {"60 s of motion": {"Analysis/Model": "condensed", "Isolation/Duration": 60}}),
    ("three dimensions", "solid-tilted-a",
     {name: {"Mesh/Face size": size, "Mesh/Elements across": across} for name, size, across in (("63k", 2, 4), ("248k", 1, 10), ("400k", 1, 16))}),
    ("eigenvalues", "stability-a", {model: {"Analysis/Model": model, **ALONE} for model in MODELS[:3]}),
]


# Scene, what is common, what is varied, a measure of size from it, and of the parts in /meta the power of that size that theory gives.
SERIES = [
    # A plane mesh graded away from the face has N ~ 1/h displacements down to about 0.1 mm and N ~ 1/h^2 further on; nested dissection
    # factorises in N^1.5, substitution costs N log N for each of the contact's dofs in the window, ~ 1/h.
    ("model-a", {}, "Mesh/Face size", (0.5, 0.25, 0.125, 0.0625, 0.03125), "displacements",
     {"mesh": 1, "model": 1.5, "steps_and_output": 1.5, "fields": 1.5, "accuracy": 1.5}),
    ("model-a", {"Output/Fields": "none"}, "Analysis/Step", (0.8, 0.4, 0.2, 0.1), "steps", {"steps_and_output": 1, "output": 1, "model": 0}),
    ("model-a", {"Output/Fields": "none"}, "Drive/Cycles", (2, 4, 8, 16), "steps", {"steps_and_output": 1, "output": 1, "accuracy": 0}),
    # The basis: N^1.5 for factors and as many substitutions as dofs, ~ N; steps: dense in the dofs in contact.
    ("reversal-a", {"Analysis/Model": "condensed", "Output/Fields": "none"}, "Mesh/Face size", (1, 0.5, 0.25, 0.125), "displacements",
     {"basis": 1.5, "steps_and_output": 1.5}),
    ("reversal-a", {"Analysis/Model": "condensed", "Output/Fields": "none", "Time/Step": 1e-4}, "Condensed/Modes", (10, 20, 40, 80), "modes",
     {"steps_and_output": 1}),
    ("reversal-a", {"Analysis/Model": "beam", "Output/Fields": "none"}, "Time/Step", (4e-5, 2e-5, 1e-5, 5e-6), "steps", {"steps_and_output": 1}),
]
GROWTH_WIDTHS = (34, 26, 10, 10, 0)


def measure(sprag, scene, changes, folder):
    """Numbers of a run in the order of COLUMNS, without its name and ratio."""
    cache = tempfile.mkdtemp(dir=folder)  # a stored basis would be used
    run_scene(sprag, scene + ".prm", {"Output/Fields": "none", "Condensed/Cache": cache, **changes}, folder + "/out", "--overwrite")
    with h5py.File(Path(folder) / "out/result.h5") as file:
        number = lambda name: float(file[name][()]) if name in file else 0.0
        sums = [sum(number("meta/cpu_time_" + phase) for phase in phases) for phases in (MODEL, STEPS)]
        counts = [number(name) for name in ("meta/degrees_of_freedom", "meta/coordinates", "summary/steps", "summary/iterations")]
        cpu = number("meta/cpu_time_all") or number("meta/cpu_time")
        return [*counts, *sums, cpu, number("meta/steps_per_cpu_second"), number("meta/peak_memory")]


def print_growth(sprag):
    print_row(("varied", "part", "power", "theory", "CPU seconds over size"), GROWTH_WIDTHS)
    for scene, common, name, values, measured, expected in SERIES:
        sizes, seconds = [], {part: [] for part in expected}
        for value in values:
            with tempfile.TemporaryDirectory(prefix="sprag-cost-") as folder:
                run_scene(sprag, scene + ".prm", {**common, "Condensed/Cache": folder, name: value}, folder + "/out")
                with h5py.File(Path(folder) / "out/result.h5") as file:
                    size = {"modes": value, "steps": file["summary/steps"][()], "displacements": file["meta/degrees_of_freedom"][()]}
                    sizes.append(float(size[measured]))
                    for part in expected:
                        seconds[part].append(float(file["meta/cpu_time_" + part][()]))
        for part, power in expected.items():
            # Between the two largest sizes, where what does not grow counts least.
            found = np.log(seconds[part][-1] / seconds[part][-2]) / np.log(sizes[-1] / sizes[-2])
            listed = ", ".join(f"{second:.3g} ({size:.3g})" for second, size in zip(seconds[part], sizes))
            print_row((f"{scene} {name}", f"{part} over {measured}", f"{found:.2f}", f"{power}", listed), GROWTH_WIDTHS)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--only", default="", help="groups whose name contains this text")
    parser.add_argument("--growth", action="store_true", help="how the parts of a run grow")
    arguments = parser.parse_args()
    if arguments.growth:
        return print_growth(arguments.sprag)
    for group, scene, runs in GROUPS:
        if arguments.only not in group:
            continue
        print_row((f"\n{group}", *COLUMNS[1:]), (WIDTHS[0] + 1, *WIDTHS[1:]))
        reference = None
        for name, changes in runs.items():
            with tempfile.TemporaryDirectory(prefix="sprag-cost-") as folder:
                row = measure(arguments.sprag, scene, changes, folder)
            reference = reference or row[6]
            cells = [f"{value:.2f}" if 4 <= column <= 6 else f"{value:.0f}" for column, value in enumerate(row)]
            print_row((name, *cells, f"{row[6] / reference:.2f}"), WIDTHS)


if __name__ == "__main__":
    main()
