#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what --validate expects of runs, CPU time and memory, against what they take; see expected-cost.md."""

import argparse
import re
import subprocess
import tempfile
from pathlib import Path

import h5py
from runs import ROOT, add_program, measure_cpu, print_row

ALONE = {"Stability/Critical": "none", "Stability/Roles": "off"}
RANGES = "Contact/Damping 0.01 0.1; Friction/Factor 0.8 1.2"
CASES = [
    ("model-a", {}),
    ("model-a", {"Mesh/Face size": 1}),
    ("model-a", {"Mesh/Face size": 0.0625}),
    ("model-a", {"Analysis/Step": 0.1}),
    ("model-b", {"Drive/Cycles": 4}),
    ("cylinder-a", {}),
    ("pair-a", {}),
    ("plate-a", {}),
    ("apparatus-a", {}),
    ("closed-form-a", {}),
    ("reversal-a", {}),
    ("reversal-a", {"Analysis/Model": "condensed"}),
    ("reversal-b", {"Analysis/Model": "condensed", "Mesh/Face size": 0.5}),
    ("reversal-a", {"Analysis/Model": "finite element"}),
    ("plate-reversal-a", {}),
    ("pair-reversal-a", {}),
    ("isolation-ground-a", {"Analysis/Model": "condensed", "Isolation/Duration": 10}),
    ("isolation-free-a", {"Analysis/Model": "condensed", "Isolation/Duration": 6, "Mesh/Face size": 2}),
    ("isolation-free-a", {"Analysis/Model": "beam", "Isolation/Duration": 20}),
    ("isolation-sprag-slip-a", {}),
    ("modal-a", {}),
    ("stability-a", {}),
    ("stability-a", {"Analysis/Model": "condensed", **ALONE}),
    ("stability-a", {"Stability/Critical": "Lever/Depth 4 6", "Stability/Ranges": RANGES}),
    ("stability-a", {"Stability/Critical": "Lever/Depth 15 25", "Stability/Ranges": RANGES}),
    ("stability-a", {"Analysis/Type": "study", "Study/Type": "stability", "Study/Vary": "Lever/Depth = 5 ... 20 : 1000", **ALONE}),
    ("pair-stability-a", {}),
    ("map-offset-inclination", {}),
    ("map-friction-depth-a", {}),
    ("map-friction-position-a", {}),
    ("map-position-depth-b", {}),
    ("isolation-ground-a", {}),
    ("study-a", {}),
]
WIDTHS = (56, 10, 10, 8, 10, 10, 8)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    arguments = parser.parse_args()
    print_row(("run", "expected s", "CPU s", "ratio", "expected GB", "GB", "ratio"), WIDTHS)
    outside = 0
    with tempfile.TemporaryDirectory() as folder:
        for scene, changes in CASES:
            command = [arguments.sprag, str(ROOT / "params" / (scene + ".prm")), *(f"--set={name}={value}" for name, value in changes.items())]
            text = subprocess.run([*command, "--validate"], check=True, capture_output=True, text=True).stdout
            expected = re.search(r"about (\S+) s of CPU time, (\S+) GB", text)
            seconds, gigabytes = (float(number) for number in expected.groups())
            # A stored basis would be used.
            command += ["--overwrite", "--output", folder + "/out", "--set=Condensed/Cache=" + tempfile.mkdtemp(dir=folder)]
            _, cpu = measure_cpu(lambda words=command: subprocess.run(words, check=True, capture_output=True))
            with h5py.File(Path(folder) / "out/result.h5") as file:
                memory = float(file["meta/peak_memory"][()]) * 2**20 / 1e9
            outside += not 0.5 <= seconds / cpu <= 2
            outside += not 1 / 1.3 <= gigabytes / memory <= 1.3
            name = scene + "".join(f" {value}" for value in changes.values())
            print_row((name, f"{seconds:.2f}", f"{cpu:.2f}", f"{seconds / cpu:.2f}", f"{gigabytes:.2f}", f"{memory:.2f}",
                       f"{gigabytes / memory:.2f}"), WIDTHS)
    print(f"{outside} are beyond a factor of 2 in time or 1.3 in memory")


if __name__ == "__main__":
    main()
