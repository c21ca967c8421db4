#!/usr/bin/python3
"""Prints what runs tell of their errors (/accuracy) against their true errors, those against a reference on a mesh four times finer
with the augmented Lagrangian method. Effectivity is told over true; see README.md."""

import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, print_row, run_scene

# Scene of params/ and what is changed in it. The estimates were made with A and B as they are; nothing was fitted to the others.
CASES = [
    ("model-a", {}),
    ("model-b", {}),
    ("model-a", {"Contact/Enforcement": "augmented Lagrangian"}),
    ("model-a", {"Mesh/Face size": 0.5}),
    ("model-a", {"Mesh/Face size": 1}),
    ("model-a", {"Mesh/Degree": 1}),
    ("model-a", {"Contact/Penalty": 200}),
    ("model-a", {"Friction layer/Thickness": 3}),
    ("model-a", {"Friction layer/Young's modulus": 200}),
    ("model-a", {"Lever/Depth": 8}),
    ("model-a", {"Geometry/Cylinder radius": 80, "Geometry/Interface offset": 60}),
    ("model-a", {"Friction/Law": "Coulomb", "Friction/Coefficient": 0.3, "Drive/Stroke": 30}),
    ("model-b", {"Friction layer/Young's modulus": 40}),
    ("model-b", {"Drive/Profile": "harmonic", "Lever/Depth": 12}),
    ("cylinder-a", {}),
    ("stiff-b", {}),
]
QUANTITIES = ("P", "Q", "loop_area", "largest_pressure", "contact_width")
COLUMNS = ("P", "Q", "largest_pressure", "contact_width", "x", "v", "drive_work")
FINER = 4
CYLINDER_FACE_SIZE = 0.25  # by default [mm]
WIDTHS = (24, 11, 11, 10)


class Run:
    def __init__(self, sprag, scene, changes, folder):
        run_scene(sprag, scene + ".prm", {"Output/Fields": "none", **changes}, folder, "--overwrite")
        with h5py.File(Path(folder) / "result.h5") as file:
            self.table = {name: file["table/" + name][:] for name in COLUMNS}
            self.told = {name: float(file["accuracy/" + name][()]) for name in QUANTITIES}
            self.face_size = float(file["meta/face_size"][()])
            self.cost = float(file["meta/cpu_time_accuracy"][()]) / float(file["meta/cpu_time"][()])
        turn = int(np.argmax(self.table["x"]))
        self.turning_point = self.table["x"][turn]
        self.strokes = (slice(0, turn + 1), slice(turn + 1, None))

    def at(self, name, x, stroke):
        """A column over x of a stroke by cubics through four rows: lines between rows would be further off than the run."""
        rows = self.strokes[stroke]
        order = np.argsort(self.table["x"][rows])
        places, values = self.table["x"][rows][order], self.table[name][rows][order]
        first = np.clip(np.searchsorted(places, x) - 2, 0, len(places) - 4)
        result = np.zeros_like(x)
        for i in range(4):
            weight = np.ones_like(x)
            for j in range(4):
                if j != i:
                    weight *= (x - places[first + j]) / (places[first + i] - places[first + j])
            result += weight * values[first + i]
        return result


def true_errors(run, reference):
    """Without what the strokes remember of their beginning, and where the lever hardly touches."""
    errors = {}
    table = run.table
    for name in ("P", "Q", "largest_pressure", "contact_width"):
        largest = np.abs(reference.table[name]).max()
        errors[name] = 0.0
        for stroke, rows in enumerate(run.strokes):
            x = table["x"][rows]
            counts = table["P"][rows] > 0.02 * table["P"].max()
            if stroke:
                counts &= np.abs(x - run.turning_point) > 2 * table["contact_width"].max()
            difference = table[name][rows][counts] - reference.at(name, x[counts], stroke)
            errors[name] = max(errors[name], np.abs(difference).max() / largest)
    work = lambda which: which.table["drive_work"][-1]
    errors["loop_area"] = abs(work(run) / work(reference) - 1)
    peak = lambda which: which.table["largest_pressure"].max()
    errors["largest_pressure"] = abs(peak(run) / peak(reference) - 1)
    return errors


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--cases", type=int, help="of the list only the first so many")
    arguments = parser.parse_args()
    print_row(("quantity", "told", "true", "told/true"), WIDTHS)
    outside = 0
    for scene, changes in CASES[: arguments.cases]:
        with tempfile.TemporaryDirectory() as folder:
            run = Run(arguments.sprag, scene, changes, folder)
            sizes = {"Mesh/Face size": run.face_size / FINER, "Cylinder/Face size": CYLINDER_FACE_SIZE / FINER}
            finer = {**changes, **sizes, "Contact/Enforcement": "augmented Lagrangian", "Contact/Penalty": "auto", "Mesh/Degree": 2}
            reference = Run(arguments.sprag, scene, {**finer, "Analysis/Step": 0.5}, folder)
        print(f"{scene} {changes or ''}: telling took {100 * run.cost:.0f} % of the run")
        errors = true_errors(run, reference)
        for name in QUANTITIES:
            ratio = run.told[name] / errors[name]
            outside += not 0.5 <= ratio <= 3
            print_row(("  " + name, f"{run.told[name]:.1e}", f"{errors[name]:.1e}", f"{ratio:.2f}"), WIDTHS)
    print(f"{outside} of the ratios are outside of 0.5 ... 3")


if __name__ == "__main__":
    main()
