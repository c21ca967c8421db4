#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Error of P and Q over Analysis/Step where mu depends on speed: steps.py [SCENE] [--set "Section/Name=value"]...

The reference has half the face size, augmented Lagrangian contact and steps of 0.125 mm. Errors are the largest over both strokes, the
first 0.5 mm after the reversal apart, over the peak of the stroke. SPRAG names another program to be held against the reference, which is
always that of build/sprag."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

SOURCE = Path(__file__).resolve().parents[2]
BUILT = str(SOURCE / "build" / "sprag")
SPRAG = os.environ.get("SPRAG", BUILT)
STEPS = (10, 4, 2, 1, 0.5, 0.25, 0.125)


def strokes(program, scene, folder, *changes):
    """{way: (x, P, Q)} with x increasing."""
    options = [word for change in ("Output/Fields=none", *changes) for word in ("--set", change)]
    subprocess.run([program, scene, "--output", folder, "--quiet", *options], check=True)
    with h5py.File(Path(folder) / "result.h5") as file:
        x, v, P, Q = (file[f"table/{name}"][:] for name in ("x", "v", "P", "Q"))
    result = {}
    for way, sign in (("forward", 1), ("backward", -1)):
        rows = np.signbit(v) == (sign < 0)
        order = np.argsort(x[rows])
        result[way] = tuple(values[rows][order] for values in (x, P, Q))
    return result


def error(found, reference, column):
    """The reference is joined by lines of 0.125 mm."""
    largest = 0
    for way, values in found.items():
        x, known = values[0], reference[way]
        rows = (x > 0.5) & (x < known[0][-1] - 0.5)
        exact = np.interp(x[rows], known[0], known[column])
        largest = max(largest, np.max(np.abs(values[column][rows] - exact)) / np.max(np.abs(known[column])))
    return largest


def main(arguments):
    scene = arguments[0] if arguments and not arguments[0].startswith("--") else SOURCE / "params" / "model-a.prm"
    changes = [arguments[i + 1] for i, word in enumerate(arguments) if word == "--set"]
    with tempfile.TemporaryDirectory(prefix="sprag-steps-") as folder:
        finer = ("Mesh/Face size=0.25", "Contact/Enforcement=augmented Lagrangian", "Analysis/Step=0.125")
        reference = strokes(BUILT, scene, folder, *changes, *finer)
        print("step [mm]   error of P   error of Q")
        for step in STEPS:
            found = strokes(SPRAG, scene, folder, *changes, f"Analysis/Step={step}")
            print(f"{step:9g}   {error(found, reference, 1):10.2e}   {error(found, reference, 2):10.2e}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
