#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints how the largest pressure, the profile of the pressure and the width of the contact of model A converge, for penalty and
augmented Lagrangian, against hard contact on a fine mesh; see pressure.md."""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PLACES = [(way, x) for way in (1, -1) for x in (13, 26, 39, 52, 65)]
GRID = np.linspace(-2.5, 2.5, 2001)  # from the centre of pressure [mm]
NEAR_TURN = 1.0  # of x, where stick ends after the reversal: the backward stroke is compared there instead of at 65 mm
PENALTIES = (100, 300)  # of the reference, over its face size [N/mm^2], extrapolated to none as their error falls with 1/penalty
FINEST = {"model-a": 0.03125, "cylinder-a": 0.0625}  # face size of the reference [mm]
COMMON = {"Friction/Law": "Coulomb", "Friction/Coefficient": 0.73, "Output/Fields": "none"}
METHODS = {"penalty": "penalty", "AL": "augmented Lagrangian"}


class Run:
    """Rows and profiles of one run over x, each way."""

    def __init__(self, sprag, scene, settings):
        with tempfile.TemporaryDirectory() as folder:
            options = [f"--set={name}={value}" for name, value in {**COMMON, **settings}.items()]
            command = [sprag, scene, "--quiet", "--output", folder + "/out", *options]
            before = os.times()
            subprocess.run(command, check=True)
            after = os.times()
            self.cpu = after.children_user + after.children_system - before.children_user - before.children_system
            with h5py.File(folder + "/out/result.h5") as file:
                self.table = {name: file["table/" + name][:] for name in ("x", "v", "s", "largest_pressure", "contact_width")}
                self.xi = file["face/xi"][:]
                self.pressure = file["face/pressure"][:]

    def profile(self, row):
        return np.interp(GRID + self.table["s"][row], self.xi, self.pressure[row])

    def at(self, way, x):
        """Largest pressure, width and profile, linear between the rows of a stroke."""
        x = min(x, 65 - NEAR_TURN) if way < 0 else x
        rows = np.flatnonzero((self.table["v"] * way > 0) & (self.table["largest_pressure"] > 0))
        rows = rows[np.argsort(self.table["x"][rows])]
        place = np.clip(np.searchsorted(self.table["x"][rows], x), 1, len(rows) - 1)
        before, after = rows[place - 1], rows[place]
        share = (x - self.table["x"][before]) / (self.table["x"][after] - self.table["x"][before])
        mix = lambda value: (1 - share) * value(before) + share * value(after)
        return (
            mix(lambda row: self.table["largest_pressure"][row]),
            mix(lambda row: self.table["contact_width"][row]),
            mix(self.profile),
        )


def extrapolated(runs):
    """Towards no overlap: the error falls with 1/penalty."""
    factor = PENALTIES[1] / PENALTIES[0]
    return {place: [(factor * fine - coarse) / (factor - 1) for coarse, fine in zip(*(run.at(*place) for run in runs))]
            for place in PLACES}


def norm(profile):
    return np.sqrt(np.sum(profile**2))


def errors(run, reference):
    """Returns the errors of largest pressure, width and profile at every place."""
    result = []
    for place in PLACES:
        largest, width, profile = run.at(*place)
        reference_largest, reference_width, reference_profile = reference[place]
        result.append((largest / reference_largest - 1, width / reference_width - 1, norm(profile - reference_profile) / norm(reference_profile)))
    return np.array(result)


def line(name, values, order=None, digits=1):
    cells = " | ".join(f"{value:.{digits}f}" for value in values)
    print(f"| {name} | {cells} | {'' if order is None else f'{order:.1f}'} |", flush=True)


def settings(scene, size, degree):
    result = {"Mesh/Face size": size, "Mesh/Degree": degree}
    return {**result, "Cylinder/Face size": size} if scene.stem == "cylinder-a" else result


def hard_contact(sprag, scene):
    size = FINEST[scene.stem]
    fine = [Run(sprag, scene, {**settings(scene, size, 2), "Contact/Penalty": penalty / size}) for penalty in PENALTIES]
    reference = extrapolated(fine)
    own = errors(fine[1], reference)
    print(f"\n{scene.name}; reference: hard contact on faces of {size} mm, degree 2; its stiffer penalty is "
          f"{100 * np.abs(own[:, 0]).max():.2f} % of the largest pressure and {100 * np.abs(own[:, 1]).max():.2f} % of the width off")
    return reference


def table(sprag, scene, degree, sizes, reference):
    print(f"\n{scene.name}, degree {degree}\n")
    print("| | " + " | ".join(f"{'forward' if way > 0 else 'back'} {min(x, 64) if way < 0 else x}" for way, x in PLACES) + " | order |")
    print("|---" * (len(PLACES) + 2) + "|")
    line("largest pressure [MPa]", [reference[place][0] for place in PLACES], digits=4)
    line("width [mm]", [reference[place][1] for place in PLACES], digits=3)
    for name, enforcement in METHODS.items():
        before = None
        for size in sizes:
            run = Run(sprag, scene, {**settings(scene, size, degree), "Contact/Enforcement": enforcement})
            found = errors(run, reference)
            for column, what in enumerate(("largest pressure", "width", "profile")):
                order = None
                if before is not None:
                    order = np.log2(norm(before[:, column]) / norm(found[:, column]))
                label = f"{name}, {size} mm ({run.cpu:.2f} s): {what} [%]" if column == 0 else f"{what} [%]"
                line(label, 100 * found[:, column], order)
            before = found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sprag", type=Path, default=ROOT / "build/sprag")
    parser.add_argument("--sizes", type=float, nargs="+", default=[1, 0.5, 0.25, 0.125])
    parser.add_argument("--degrees", type=int, nargs="+", default=[2, 1])
    parser.add_argument("--scenes", nargs="+", choices=FINEST, default=FINEST)
    options = parser.parse_args()
    for name in options.scenes:
        sprag, scene = options.sprag.resolve(), ROOT / f"params/{name}.prm"
        reference = hard_contact(sprag, scene)
        for degree in options.degrees if name == "model-a" else [2]:  # linear cells cannot be a round cylinder
            table(sprag, scene, degree, options.sizes, reference)


if __name__ == "__main__":
    sys.exit(main())
