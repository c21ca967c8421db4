#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what runs tell of their errors (/accuracy) against their true errors, those against a reference on a mesh four times finer
with the augmented Lagrangian method, of held slides with penalties extrapolated to none. With --draw the devices are drawn at random.
See told-errors.md."""

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
# In time, with the settings of the reference: shorter steps, for meshed levers a finer face and a stiffer penalty.
SHORT_STEPS = {"Time/Tolerance": 1e-5}
FINE_IN_TIME = {"Time/Tolerance": 1e-4, "Mesh/Face size": 0.125, "Contact/Penalty": 2e4}
IN_TIME = [
    ("reversal-a", {"Analysis/Model": "rigid"}, SHORT_STEPS),
    ("reversal-a", {"Analysis/Model": "rigid", "Time/Step": 5e-5}, {"Time/Step": 5e-6}),
    ("reversal-a", {"Analysis/Model": "beam", "Time/Tolerance": 2e-2}, SHORT_STEPS),
    ("reversal-a", {"Analysis/Model": "condensed"}, FINE_IN_TIME),
    ("reversal-a", {"Analysis/Model": "condensed", "Mesh/Face size": 0.5}, FINE_IN_TIME),
    ("reversal-b", {"Analysis/Model": "beam"}, SHORT_STEPS),
    ("reversal-b", {"Analysis/Model": "condensed"}, FINE_IN_TIME),
    ("plate-reversal-a", {}, FINE_IN_TIME),
    ("support-a", {}, SHORT_STEPS),
    ("harmonic-a", {"Analysis/Model": "beam"}, SHORT_STEPS),
    ("pair-reversal-a", {"Analysis/Model": "beam"}, SHORT_STEPS),
]
OF_RINGING = {"overshoot": "reversal_1_overshoot_P", "frequency": "reversal_1_frequency"}
QUANTITIES = ("P", "Q", "loop_area", "largest_pressure", "contact_width", "largest_stress")
STRESSES = ("largest_lever_stress", "largest_layer_stress")
COLUMNS = ("P", "Q", "largest_pressure", "contact_width", "x", "v", "drive_work")
OF_SLIDES = ("growth_rate", "frequency")
ALONE = {"Analysis/Model": "condensed", "Stability/Critical": "none", "Stability/Roles": "off", "Output/Fields": "none"}
FACE_SIZE_OF_SLIDES = 0.5  # by default [mm]
PENALTIES = (1.2e4, 3.6e4)  # of their references [N/mm^3]
FINER = 4
CYLINDER_FACE_SIZE = 0.25  # by default [mm]
WIDTHS = (24, 11, 11, 10)


class Run:
    def __init__(self, sprag, scene, changes, folder):
        run_scene(sprag, scene + ".prm", {"Output/Fields": "none", **changes}, folder, "--overwrite")
        with h5py.File(Path(folder) / "result.h5") as file:
            self.table = {name: file["table/" + name][:] for name in COLUMNS}
            self.estimates = {name: float(file["accuracy/" + name][()]) for name in QUANTITIES}
            self.peaks = {
                (name, way): float(file[f"summary/peak_{name}_{way}"][()])
                for name in ("P", "Q")
                for way in ("forward", "backward")
                if f"summary/peak_{name}_{way}" in file
            }
            self.pressure = float(file["summary/largest_pressure"][()])
            self.stresses = [float(file["summary/" + name][()]) for name in STRESSES]
            self.face_size = float(file["meta/face_size"][()])
            self.cost = float(file["meta/cpu_time_accuracy"][()]) / float(file["meta/cpu_time"][()])
        turn = int(np.argmax(self.table["x"]))
        self.turning_point = self.table["x"][turn]
        self.strokes = [slice(0, turn + 1), slice(turn + 1, None)][: 1 + (turn + 1 < len(self.table["x"]))]

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
    """Without what the strokes remember of their beginning, and where the lever hardly touches, but with the largest P and Q that are
    printed."""
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
    errors["largest_pressure"] = abs(run.pressure / reference.pressure - 1)
    for (name, way), value in run.peaks.items():
        change = abs(value - reference.peaks[name, way]) / np.abs(reference.table[name]).max()
        errors[name] = max(errors[name], change)
    errors["largest_stress"] = max(abs(a / b - 1) for a, b in zip(run.stresses, reference.stresses))
    return errors


def slide(sprag, scene, changes, folder):
    """Results of a held slide, what it tells of them and the share of the time that takes."""
    run_scene(sprag, scene + ".prm", {**ALONE, **changes}, folder, "--overwrite")
    with h5py.File(Path(folder) / "result.h5") as file:
        found = {name: float(file["summary/" + name][()]) for name in OF_SLIDES}
        estimates = {name: float(file["accuracy/" + name][()]) for name in OF_SLIDES}
        return found, estimates, float(file["meta/cpu_time_accuracy"][()]) / float(file["meta/cpu_time"][()])


def slide_errors(sprag, scene, changes, folder, found):
    finer = {**changes, "Mesh/Face size": FACE_SIZE_OF_SLIDES / FINER}
    soft, stiff = (slide(sprag, scene, {**finer, "Contact/Penalty": penalty}, folder)[0] for penalty in PENALTIES)
    share = 1 / (PENALTIES[1] / PENALTIES[0] - 1)
    exact = {name: stiff[name] + share * (stiff[name] - soft[name]) for name in OF_SLIDES}
    return {name: abs(found[name] / exact[name] - 1) for name in OF_SLIDES}


def in_time(sprag, scene, changes, folder):
    """Times, P and measures of the ringing of a run, what it tells of them and the share of the time that takes."""
    run_scene(sprag, scene + ".prm", {"Output/Fields": "none", **changes}, folder, "--overwrite")
    with h5py.File(Path(folder) / "result.h5") as file:
        found = {name: float(file["summary/" + entry][()]) for name, entry in OF_RINGING.items()}
        estimates = {name: float(file["accuracy/" + name][()]) for name in ("P", *OF_RINGING)}
        share = float(file["meta/cpu_time_accuracy"][()]) / float(file["meta/cpu_time"][()])
        return (file["table/time"][:], file["table/P"][:], found), estimates, share


def errors_in_time(run, reference):
    time, P, found = run
    reference_time, reference_P, exact = reference
    errors = {"P": np.abs(P - np.interp(time, reference_time, reference_P)).max() / reference_P.max()}
    return {**errors, **{name: abs(found[name] / exact[name] - 1) for name in OF_RINGING}}


def print_case(scene, changes, cost, estimates, errors):
    """Returns how many of the ratios are outside."""
    print(f"{scene} {changes or ''}: telling took {100 * cost:.0f} % of the run")
    outside = 0
    for name, error in errors.items():
        ratio = estimates[name] / error  # NaN where words are told
        outside += ratio < 0.5 or ratio > 3
        print_row(("  " + name, f"{estimates[name]:.1e}", f"{error:.1e}", f"{ratio:.2f}"), WIDTHS)
    return outside


def run_errors(sprag, scene, changes, folder, run):
    sizes = {"Mesh/Face size": run.face_size / FINER, "Cylinder/Face size": CYLINDER_FACE_SIZE / FINER}
    finer = {**changes, **sizes, "Contact/Enforcement": "augmented Lagrangian", "Contact/Penalty": "auto", "Mesh/Degree": 2}
    return true_errors(run, Run(sprag, scene, {**finer, "Analysis/Step": 0.5}, folder))


SPACE = {"Analysis/Dimension": 3, "Mesh/Elements across": 2, "Mesh/Face size": 1, "Drive/Cycles": 0.5, "Analysis/Step": 4}
FINE_IN_SPACE = {"Mesh/Elements across": 4, "Mesh/Face size": 0.5}


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
    """(kind, changes) in turn along the drive, of a held slide, in time and in space."""
    generator = np.random.default_rng(seed)
    for i in range(number):
        device = drawn_device(generator)
        kind = ("plane", "slide", "time", "space")[i % 4]
        stroke = device.pop("Drive/Stroke")
        if kind == "slide":
            yield kind, {**device, "Stability/Position": stroke * generator.uniform(0.5, 1), "Stability/Direction": "backward"}
        elif kind == "time":
            yield kind, {**device, "Analysis/Model": "condensed", "Mesh/Face size": 0.5, "Drive/Start": stroke - 10, "Drive/Stroke": stroke}
        elif kind == "space":
            yield kind, {**device, "Drive/Stroke": stroke, "Lever/Width": 10, **SPACE}
        else:
            yield kind, {**device, "Drive/Stroke": stroke}


def print_drawn(sprag, number, seed, folder):
    print(f"seed {seed}")
    outside = 0
    for kind, changes in drawn_cases(number, seed):
        try:
            if kind == "slide":
                found, estimates, cost = slide(sprag, "stability-a", changes, folder)
                errors = slide_errors(sprag, "stability-a", changes, folder, found)
            elif kind == "time":
                found, estimates, cost = in_time(sprag, "reversal-a", changes, folder)
                errors = errors_in_time(found, in_time(sprag, "reversal-a", {**changes, **FINE_IN_TIME}, folder)[0])
            else:
                run = Run(sprag, "model-a", changes, folder)
                estimates, cost = run.estimates, run.cost
                space = lambda: true_errors(run, Run(sprag, "model-a", {**changes, **FINE_IN_SPACE}, folder))
                errors = space() if kind == "space" else run_errors(sprag, "model-a", changes, folder, run)
            outside += print_case(kind, changes, cost, estimates, errors)
        except RuntimeError as error:
            print(f"{kind} {changes}: {error}", flush=True)
    print(f"{outside} of the ratios are outside of 0.5 ... 3")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--cases", type=int, help="of both lists only the first so many")
    parser.add_argument("--draw", type=int, help="so many devices drawn at random, a quarter each along the drive, held, in time, in space")
    parser.add_argument("--seed", type=int, default=1, help="of --draw")
    arguments = parser.parse_args()
    print_row(("quantity", "told", "true", "told/true"), WIDTHS)
    outside = 0
    with tempfile.TemporaryDirectory() as folder:
        if arguments.draw:
            return print_drawn(arguments.sprag, arguments.draw, arguments.seed, folder)
        for scene, changes in CASES[: arguments.cases]:
            run = Run(arguments.sprag, scene, changes, folder)
            errors = run_errors(arguments.sprag, scene, changes, folder, run)
            outside += print_case(scene, changes, run.cost, run.estimates, errors)
        for scene, changes in SLIDES[: arguments.cases]:
            found, estimates, cost = slide(arguments.sprag, scene, changes, folder)
            errors = slide_errors(arguments.sprag, scene, changes, folder, found)
            outside += print_case(scene, changes, cost, estimates, errors)
        for scene, changes, finer in IN_TIME[: arguments.cases]:
            run, estimates, cost = in_time(arguments.sprag, scene, changes, folder)
            reference, _, _ = in_time(arguments.sprag, scene, {**changes, **finer}, folder)
            outside += print_case(scene, changes, cost, estimates, errors_in_time(run, reference))
    print(f"{outside} of the ratios are outside of 0.5 ... 3")


if __name__ == "__main__":
    main()
