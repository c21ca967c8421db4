#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints whether targets are met or told to be missed, and what it costs to ask for an accuracy: the CPU time of runs with Accuracy/Target, their true and their told errors, and the cheapest
settings of a grid whose true error is within the target: along the drive, of held slides and in time; see expected-cost.md."""

import argparse
import collections
import itertools
import tempfile

import numpy as np
from effectivity import OF_RINGING, OF_SLIDES, AlongDrive, Held, InTime, drawn_device, without_penalty
from runs import add_program, measure_cpu, print_row

TARGETS = (0.1, 1e-2, 1e-3, 1e-4)
OF_FORCES = ("P", "Q", "loop_area")
PRESSURE = ("largest_pressure",)
DRAWN = [drawn_device(np.random.default_rng(seed)) for seed in (1, 2, 3)]
CONDENSED = {"Analysis/Model": "condensed"}


def backward(device):
    return {**device, "Stability/Position": 0.9 * device["Drive/Stroke"], "Stability/Direction": "backward"}


def before_turning(device):
    return {**device, **CONDENSED, "Drive/Start": device["Drive/Stroke"] - 10}


CASES = [
    *((AlongDrive, scene, {}, quantities) for quantities in (OF_FORCES, PRESSURE) for scene in ("model-a", "model-b")),
    *((AlongDrive, "model-a", device, quantities) for device in DRAWN for quantities in (OF_FORCES, PRESSURE)),
    *((Held, scene, {}, OF_SLIDES) for scene in ("stability-a", "stability-b")),
    *((Held, "stability-a", backward(device), OF_SLIDES) for device in DRAWN),
    *((InTime, scene, CONDENSED, tuple(OF_RINGING)) for scene in ("reversal-a", "reversal-b")),
    *((InTime, "reversal-a", before_turning(device), tuple(OF_RINGING)) for device in DRAWN),
]
# Values of each parameter whose combinations are tried by hand.
GRIDS = {
    AlongDrive: {"Mesh/Degree": (1, 2), "Mesh/Face size": (0.125, 0.25, 0.5, 1, 2), "Analysis/Step": (0.5, 2, 8), "Mesh/Faces in contact": (0, 4)},
    Held: {"Mesh/Face size": (0.125, 0.25, 0.5, 1, 2), "Contact/Penalty": ("auto", 1e4)},
    InTime: {"Mesh/Face size": (0.25, 0.5, 1, 2), "Time/Tolerance": (2e-2, 5e-3, 1e-3)},
}
FINE = {"Mesh/Face size": 0.0625, "Analysis/Step": 0.25, "Contact/Enforcement": "augmented Lagrangian"}
# Runs asked for 0.1 % have faces of 0.1 mm and penalties of 6e4 N/mm3.
FINE_RINGING = {"Mesh/Face size": 0.0625, "Time/Tolerance": 2e-4}
WIDTHS = (40, 10, 10, 10, 10, 12, 12, 8, 0)


def measured(kind, sprag, scene, changes, quantities, reference, folder):
    """CPU time, largest true and told error of a run."""
    own = {**changes, "Condensed/Cache": tempfile.mkdtemp(dir=folder)}
    run, cpu = measure_cpu(lambda: kind(sprag, scene, own, folder))
    errors = run.errors(reference)
    return cpu, max(errors[name] for name in quantities), max(run.estimates[name] for name in quantities)


def grid(kind, sprag, scene, device, quantities, reference, folder):
    """(CPU time, error, name) of all settings."""
    found = []
    for values in itertools.product(*GRIDS[kind].values()):
        changes = dict(zip(GRIDS[kind], values))
        try:
            cpu, error, _ = measured(kind, sprag, scene, {**device, **changes}, quantities, reference, folder)
        except (RuntimeError, KeyError):
            continue
        found.append((cpu, error, ", ".join(f"{name.partition('/')[2]} {value}" for name, value in changes.items())))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--cases", type=int, help="only the first so many")
    parser.add_argument("--without-grid", action="store_true", help="does not look for the cheapest settings")
    arguments = parser.parse_args()
    print_row(("asked for", "target", "CPU s", "true", "told", "", "cheapest s", "ratio", "with"), WIDTHS)
    outcomes = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for kind, scene, device, quantities in CASES[: arguments.cases]:
            if kind is AlongDrive:
                reference = kind(arguments.sprag, scene, {**device, **FINE}, folder)
            elif kind is InTime:
                reference = without_penalty(kind, arguments.sprag, scene, {**device, **FINE_RINGING}, folder)
            else:
                reference = kind.reference(arguments.sprag, scene, device, folder, kind(arguments.sprag, scene, device, folder))
            settings = [] if arguments.without_grid else grid(kind, arguments.sprag, scene, device, quantities, reference, folder)
            number = next((i for i, drawn in enumerate(DRAWN) if drawn.items() <= device.items()), None)
            name = (scene if number is None else f"device {number}") + " " + ", ".join(quantities)
            # Faces of FINE are too long to tell a largest pressure to 0.01 %.
            for target in TARGETS[:-1] if quantities == PRESSURE else TARGETS:
                asked = {**device, "Accuracy/Target": target, "Accuracy/Quantity": ", ".join(quantities)}
                try:
                    cpu, error, estimate = measured(kind, arguments.sprag, scene, asked, quantities, reference, folder)
                except RuntimeError as failure:
                    print(f"{name} {target:.2g}: {failure}", flush=True)
                    continue
                cheap = min((each for each in settings if each[1] <= target), default=(float("nan"), 0, "none"))
                warns = not estimate <= target  # target_missed
                outcome = ("met" if error <= target else "told" if warns else "missed") + (", warns" if warns and error <= target else "")
                outcomes[outcome] += 1
                print_row((name, f"{target:.2g}", f"{cpu:.2f}", f"{error:.1e}", f"{estimate:.1e}", outcome,
                           f"{cheap[0]:.2f}", f"{cpu / cheap[0]:.2f}", cheap[2]), WIDTHS)
    print(", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common()))


if __name__ == "__main__":
    main()
