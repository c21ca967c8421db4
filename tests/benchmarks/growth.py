#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints how the parts of a run grow with face size, steps, cycles and modes, and the power that theory expects; see parts.md."""

import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, print_row, run_scene

WIDTHS = (34, 26, 10, 10, 0)
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


def measure_size(file, measure, value):
    if measure == "modes":
        return float(value)
    return float(file["summary/steps"][()] if measure == "steps" else file["meta/degrees_of_freedom"][()])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    arguments = parser.parse_args()
    print_row(("varied", "part", "power", "theory", "CPU seconds over size"), WIDTHS)
    with tempfile.TemporaryDirectory() as folder:
        for scene, common, name, values, measure, expected in SERIES:
            sizes, seconds = [], {part: [] for part in expected}
            for value in values:
                cache = {"Condensed/Cache": tempfile.mkdtemp(dir=folder)}
                run_scene(arguments.sprag, scene + ".prm", {**common, **cache, name: value}, folder + "/out", "--overwrite")
                with h5py.File(Path(folder) / "out/result.h5") as file:
                    sizes.append(measure_size(file, measure, value))
                    for part in expected:
                        seconds[part].append(float(file["meta/cpu_time_" + part][()]))
            for part, power in expected.items():
                # Between the two largest sizes, where what does not grow counts least.
                found = np.log(seconds[part][-1] / seconds[part][-2]) / np.log(sizes[-1] / sizes[-2])
                listed = ", ".join(f"{second:.3g} ({size:.3g})" for second, size in zip(seconds[part], sizes))
                print_row((f"{scene} {name}", f"{part} over {measure}", f"{found:.2f}", f"{power}", listed), WIDTHS)


if __name__ == "__main__":
    main()
