#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what runs tell of their errors (/accuracy) against their true errors, those against a reference on a mesh four times finer
with the augmented Lagrangian method, of held slides with penalties extrapolated to none. The true error is the root mean square over
runs with almost the same face size. With --draw the devices are drawn at random. See told-errors.md."""

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
    ("model-a", {"Contact/Enforcement": "penalty"}),
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
]
SLIDES = [
    ("stability-a", {}),
    ("stability-b", {}),
    ("stability-a", {"Lever/Depth": 14}),
    ("stability-a", {"Stability/Position": 30}),
    ("stability-a", {"Friction layer/Thickness": 2}),
]
# The references in time have shorter steps, those of meshed levers a finer face and a stiffer penalty.
SHORT_STEPS = {"Time/Tolerance": 1e-5}
FINE_IN_TIME = {"Time/Tolerance": 1e-4, "Mesh/Face size": 0.125, "Contact/Penalty": 2e4}
IN_TIME = [
    ("reversal-a", {"Analysis/Model": "rigid"}),
    ("reversal-a", {"Analysis/Model": "rigid", "Time/Step": 5e-5}),
    ("reversal-a", {"Analysis/Model": "beam", "Time/Tolerance": 2e-2}),
    ("reversal-a", {"Analysis/Model": "condensed"}),
    ("reversal-a", {"Analysis/Model": "condensed", "Mesh/Face size": 0.5}),
    ("reversal-b", {"Analysis/Model": "beam"}),
    ("reversal-b", {"Analysis/Model": "condensed"}),
    ("plate-reversal-a", {}),
    ("support-a", {}),
    ("harmonic-a", {"Analysis/Model": "beam"}),
    ("pair-reversal-a", {"Analysis/Model": "beam"}),
]
OF_RINGING = {"overshoot": "reversal_1_overshoot_P", "frequency": "reversal_1_frequency"}
QUANTITIES = ("P", "Q", "loop_area", "largest_pressure", "contact_width", "largest_lever_stress", "largest_layer_stress")
STRESSES = ("largest_lever_stress", "largest_layer_stress")
COLUMNS = ("P", "Q", "largest_pressure", "contact_width", "x", "v", "drive_work")
OF_SLIDES = ("growth_rate", "frequency")
ALONE = {"Analysis/Model": "condensed", "Stability/Critical": "none", "Stability/Roles": "off", "Output/Fields": "none"}
FACE_SIZE_OF_SLIDES, FACE_SIZE_IN_TIME = 0.5, 0.25  # by default [mm]
PENALTIES = (1.2e4, 3.6e4)  # of their references [N/mm^3]
FINER = 4
FINER_OF_SLIDES = 10  # growth scatters by 1 % over places between the nodes of 0.125 mm
FINE_IN_PLANE = {"Contact/Enforcement": "augmented Lagrangian", "Contact/Penalty": "auto", "Mesh/Degree": 2, "Analysis/Step": 0.5}
NEIGHBOURS = (0.97, 0.94, 1.03)  # face sizes over the run's, under which the contact lies elsewhere between the nodes
CYLINDER_FACE_SIZE = 0.25  # by default [mm]
WIDTHS = (24, 11, 11, 10)


def read_estimates(file, names):
    """Errors that a run tells, and the share of its time that this takes."""
    share = float(file["meta/cpu_time_accuracy"][()]) / float(file["meta/cpu_time"][()])
    return {name: float(file["accuracy/" + name][()]) for name in names}, share


class AlongDrive:
    """A run without inertia."""

    def __init__(self, sprag, scene, changes, folder):
        run_scene(sprag, scene + ".prm", {"Output/Fields": "none", **changes}, folder, "--overwrite")
        with h5py.File(Path(folder) / "result.h5") as file:
            self.estimates, self.cost = read_estimates(file, QUANTITIES)
            self.face_size = float(file["meta/face_size"][()])
            self.table = {name: file["table/" + name][:] for name in COLUMNS}
            self.peaks = {
                (name, way): float(file[f"summary/peak_{name}_{way}"][()])
                for name in ("P", "Q")
                for way in ("forward", "backward")
                if f"summary/peak_{name}_{way}" in file
            }
            self.pressure = float(file["summary/largest_pressure"][()])
            self.stresses = {name: float(file["summary/" + name][()]) for name in STRESSES}
        turn = int(np.argmax(self.table["x"]))
        self.turning_point = self.table["x"][turn]
        self.strokes = [slice(0, turn + 1), slice(turn + 1, None)][: 1 + (turn + 1 < len(self.table["x"]))]

    @classmethod
    def reference(cls, sprag, scene, changes, folder, run):
        if changes.get("Analysis/Dimension") == 3:
            return cls(sprag, scene, {**changes, **FINE_IN_SPACE}, folder)
        sizes = {"Mesh/Face size": run.face_size / FINER, "Cylinder/Face size": CYLINDER_FACE_SIZE / FINER}
        return cls(sprag, scene, {**changes, **sizes, **FINE_IN_PLANE}, folder)

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

    def errors(self, reference):
        """Without what the strokes remember of their beginning, and where the lever hardly touches, but with the largest P and Q that
        are printed."""
        errors = {}
        table = self.table
        for name in ("P", "Q", "contact_width"):
            largest = np.abs(reference.table[name]).max()
            errors[name] = 0.0
            for stroke, rows in enumerate(self.strokes):
                x = table["x"][rows]
                counts = table["P"][rows] > 0.02 * table["P"].max()
                if stroke:
                    counts &= np.abs(x - self.turning_point) > 2 * table["contact_width"].max()
                difference = table[name][rows][counts] - reference.at(name, x[counts], stroke)
                errors[name] = max(errors[name], np.abs(difference).max() / largest)
        work = lambda which: which.table["drive_work"][-1]
        errors["loop_area"] = abs(work(self) / work(reference) - 1)
        errors["largest_pressure"] = abs(self.pressure / reference.pressure - 1)
        for (name, way), value in self.peaks.items():
            change = abs(value - reference.peaks[name, way]) / np.abs(reference.table[name]).max()
            errors[name] = max(errors[name], change)
        for name, found in self.stresses.items():
            errors[name] = abs(found / reference.stresses[name] - 1)
        return errors


def without_penalty(kind, sprag, scene, changes, folder):
    """A slide or a run in time whose values are extrapolated to no penalty."""
    soft, stiff = (kind(sprag, scene, {**changes, "Contact/Penalty": penalty}, folder) for penalty in PENALTIES)
    share = 1 / (PENALTIES[1] / PENALTIES[0] - 1)
    stiff.found = {name: value + share * (value - soft.found[name]) for name, value in stiff.found.items()}
    return stiff


class Held:
    """A held slide."""

    def __init__(self, sprag, scene, changes, folder):
        run_scene(sprag, scene + ".prm", {**ALONE, **changes}, folder, "--overwrite")
        with h5py.File(Path(folder) / "result.h5") as file:
            self.estimates, self.cost = read_estimates(file, OF_SLIDES)
            self.face_size = changes.get("Mesh/Face size", FACE_SIZE_OF_SLIDES)
            self.found = {name: float(file["summary/" + name][()]) for name in OF_SLIDES}

    @classmethod
    def reference(cls, sprag, scene, changes, folder, run):
        finer = {**changes, "Mesh/Face size": FACE_SIZE_OF_SLIDES / FINER_OF_SLIDES}
        return without_penalty(cls, sprag, scene, finer, folder)

    def errors(self, reference):
        return {name: abs(value / reference.found[name] - 1) for name, value in self.found.items()}


class InTime:
    """P and measures of the ringing of a run."""

    def __init__(self, sprag, scene, changes, folder):
        run_scene(sprag, scene + ".prm", {"Output/Fields": "none", **changes}, folder, "--overwrite")
        with h5py.File(Path(folder) / "result.h5") as file:
            self.estimates, self.cost = read_estimates(file, ("P", *OF_RINGING))
            self.face_size = changes.get("Mesh/Face size", FACE_SIZE_IN_TIME) if "meta/face_points" in file else None
            self.found = {name: float(file["summary/" + entry][()]) for name, entry in OF_RINGING.items()}
            self.time, self.P = file["table/time"][:], file["table/P"][:]

    @classmethod
    def reference(cls, sprag, scene, changes, folder, run):
        finer = {"Time/Step": 5e-6} if "Time/Step" in changes else FINE_IN_TIME if run.face_size else SHORT_STEPS
        return cls(sprag, scene, {**changes, **finer}, folder)

    def errors(self, reference):
        errors = {"P": np.abs(self.P - np.interp(self.time, reference.time, reference.P)).max() / reference.P.max()}
        return {**errors, **Held.errors(self, reference)}


def print_case(kind, sprag, scene, changes, folder):
    """Prints a case and returns how many of its ratios are outside."""
    run = kind(sprag, scene, changes, folder)
    sizes = [share * run.face_size for share in NEIGHBOURS] if run.face_size else []
    runs = [run, *(kind(sprag, scene, {**changes, "Mesh/Face size": size}, folder) for size in sizes)]
    reference = kind.reference(sprag, scene, changes, folder, run)
    errors = [run.errors(reference) for run in runs]
    print(f"{scene} {changes or ''}: telling took {100 * run.cost:.0f} % of the run")
    outside = 0
    for name, estimate in run.estimates.items():
        error = np.sqrt(np.mean([each[name] ** 2 for each in errors]))
        ratio = estimate / error  # NaN where words are told
        outside += ratio < 0.5 or ratio > 3
        print_row(("  " + name, f"{estimate:.1e}", f"{error:.1e}", f"{ratio:.2f}"), WIDTHS)
    return outside


SPACE = {"Analysis/Dimension": 3, "Mesh/Elements across": 2, "Mesh/Face size": 1, "Drive/Cycles": 0.5, "Analysis/Step": 4}
FINE_IN_SPACE = {"Mesh/Elements across": 4, "Mesh/Face size": 0.4, "Analysis/Step": 1}


def drawn_device(generator):
    """A device without locking, as {parameter: value}."""
    between = lambda low, high: float(f"{generator.uniform(low, high):.3g}")
    radius = between(25, 70)
    offset = radius * between(0.4, 0.8)
    pivot = radius * between(2.8, 4)
    stroke = 0.5 * (pivot - radius)
    return {
        "Geometry/Cylinder radius": radius,
        "Geometry/Interface offset": offset,
        "Geometry/Pivot distance": pivot,
        "Geometry/Pivot height": between(0, 0.3) * (radius - offset),
        "Rotational spring/Stiffness": between(2e4, 1e5),
        "Friction/Law": "Coulomb",
        "Friction/Coefficient": between(0.2, min(0.7, 0.6 * (pivot - stroke - radius) / offset)),
        "Lever/Length": pivot + 25,
        "Lever/Width": 40,
        "Lever/Depth": between(8, 25),
        "Lever/Inertia": "as built",
        "Friction layer/Thickness": between(2, 6),
        "Friction layer/Young's modulus": between(20, 100),
        "Drive/Stroke": stroke,
    }


def drawn_cases(number, seed):
    """(kind, scene, changes) in turn along the drive, of a held slide, in time and in space."""
    generator = np.random.default_rng(seed)
    for i in range(number):
        device = drawn_device(generator)
        stroke = device["Drive/Stroke"]
        if i % 4 == 0:
            yield AlongDrive, "model-a", device
        elif i % 4 == 1:
            position = {"Stability/Position": stroke * generator.uniform(0.5, 1), "Stability/Direction": "backward"}
            yield Held, "stability-a", {**device, **position}
        elif i % 4 == 2:
            yield InTime, "reversal-a", {**device, "Analysis/Model": "condensed", "Mesh/Face size": 0.5, "Drive/Start": stroke - 10}
        else:
            yield AlongDrive, "model-a", {**device, "Lever/Width": 10, **SPACE}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--cases", type=int, help="of all lists only the first so many")
    parser.add_argument("--draw", type=int, help="so many devices drawn at random, a quarter each along the drive, held, in time, in space")
    parser.add_argument("--seed", type=int, default=1, help="of --draw")
    arguments = parser.parse_args()
    print_row(("quantity", "told", "true", "told/true"), WIDTHS)
    lists = ((AlongDrive, CASES), (Held, SLIDES), (InTime, IN_TIME))
    cases = [(kind, *case) for kind, listed in lists for case in listed[: arguments.cases]]
    outside = 0
    with tempfile.TemporaryDirectory() as folder:
        for kind, scene, changes in drawn_cases(arguments.draw, arguments.seed) if arguments.draw else cases:
            try:
                outside += print_case(kind, arguments.sprag, scene, changes, folder)
            except RuntimeError as error:
                print(f"{scene} {changes}: {error}", flush=True)
    print(f"{outside} of the ratios are outside of 0.5 ... 3")


if __name__ == "__main__":
    main()
