#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints whether targets are met or told to be missed, and what it costs to ask for an accuracy: the CPU time of runs with Accuracy/Target, their true and their told errors, and the cheapest
settings of a grid whose true error is within the target; see expected-cost.md."""

import argparse
import itertools
import os
import tempfile

import numpy as np
from effectivity import AlongDrive, drawn_device
from runs import add_program, print_row

TARGETS = (0.1, 1e-2, 1e-3, 1e-4)
OF_FORCES = ("P", "Q", "loop_area")
PRESSURE = ("largest_pressure",)
DRAWN = [drawn_device(np.random.default_rng(seed)) for seed in (1, 2, 3)]
CASES = [
    *((scene, {}, quantities) for quantities in (OF_FORCES, PRESSURE) for scene in ("model-a", "model-b")),
    *(("model-a", device, OF_FORCES) for device in DRAWN),
]
FACE_SIZES = (0.125, 0.25, 0.5, 1, 2)
STEPS = (0.5, 2, 8)
FINE = {"Mesh/Face size": 0.0625, "Analysis/Step": 0.25, "Contact/Enforcement": "augmented Lagrangian"}
WIDTHS = (34, 10, 10, 10, 10, 8, 12, 8, 0)


def measure_cpu(work):
    before = os.times()
    result = work()
    after = os.times()
    return result, after.children_user + after.children_system - before.children_user - before.children_system


def measured(sprag, scene, changes, quantities, reference, folder):
    """CPU time, largest true and told error of a run."""
    run, cpu = measure_cpu(lambda: AlongDrive(sprag, scene, changes, folder))
    errors = run.errors(reference)
    return cpu, max(errors[name] for name in quantities), max(run.estimates[name] for name in quantities)


def grid(sprag, scene, device, quantities, reference, folder):
    """(CPU time, error, name) of all settings."""
    found = []
    for degree, size, step in itertools.product((1, 2), FACE_SIZES, STEPS):
        for faces in (0, 4):
            changes = {**device, "Mesh/Degree": degree, "Mesh/Face size": size, "Analysis/Step": step, "Mesh/Faces in contact": faces}
            try:
                cpu, error, _ = measured(sprag, scene, changes, quantities, reference, folder)
            except (RuntimeError, KeyError):
                continue
            found.append((cpu, error, f"degree {degree}, {size} mm, step {step}, {faces} faces"))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--cases", type=int, help="only the first so many")
    parser.add_argument("--without-grid", action="store_true", help="does not look for the cheapest settings")
    arguments = parser.parse_args()
    print_row(("asked for", "target", "CPU s", "true", "told", "", "cheapest s", "ratio", "with"), WIDTHS)
    with tempfile.TemporaryDirectory() as folder:
        for number, (scene, device, quantities) in enumerate(CASES[: arguments.cases]):
            reference = AlongDrive(arguments.sprag, scene, {**device, **FINE}, folder)
            settings = [] if arguments.without_grid else grid(arguments.sprag, scene, device, quantities, reference, folder)
            for target in TARGETS:
                asked = {**device, "Accuracy/Target": target, "Accuracy/Quantity": ", ".join(quantities)}
                cpu, error, estimate = measured(arguments.sprag, scene, asked, quantities, reference, folder)
                cheap = min((each for each in settings if each[1] <= target), default=(float("nan"), 0, "none"))
                outcome = "met" if error <= target else "told" if not estimate <= target else "missed"
                name = (f"device {number}" if device else scene) + " " + ", ".join(quantities)
                print_row((name, f"{target:.2g}", f"{cpu:.2f}", f"{error:.1e}", f"{estimate:.1e}", outcome,
                           f"{cheap[0]:.2f}", f"{cpu / cheap[0]:.2f}", cheap[2]), WIDTHS)


if __name__ == "__main__":
    main()
