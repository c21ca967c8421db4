#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints the CPU time of a table on condensed levers over a recorded motion of its base, over the time of the motion; with --before
how far the motion is from that of an earlier build."""

import argparse
import os
import re
import subprocess
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import ROOT, add_program, print_row

SECONDS = 60.0
SHORT = 20.0
WIDTHS = (8, 10, 8, 8, 9, 9, 14, 14, 13)
COLUMNS = (("z", "mm"), ("z_rate", "mm/s"), ("damper_force", "N"), ("dissipated_energy", "N mm"))


def write_record(path):
    """300 sines between 0.5 and 10 Hz, root mean square 200 mm/s^2, a hundred samples a second."""
    random = np.random.default_rng(1)
    time = np.arange(0, SECONDS + 0.005, 0.01)
    frequencies = 0.5 + 9.5 * (np.arange(300) + random.random(300)) / 300
    phases = 2 * np.pi * random.random(300)
    values = sum(np.sin(2 * np.pi * f * time + phase) for f, phase in zip(frequencies, phases))
    values *= 200 / np.sqrt(np.mean(values**2))
    np.savetxt(path, np.column_stack((time, values)), delimiter=",", header="time [s],acceleration [mm/s2]", comments="", fmt="%.9g")


def run(sprag, record, seconds, changes, folder):
    settings = {
        "Analysis/Model": "condensed", "Isolation/Base motion": "record", "Isolation/Base table": record, "Isolation/Drift correction": "on",
        "Isolation/Initial displacement": "0", "Isolation/Duration": seconds, "Isolation/Output step": 0.01, "Condensed/Cache": folder / "cache",
        **changes,
    }
    words = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
    command = [sprag, ROOT / "params" / "isolation-free-a.prm", "--output", folder / "out", "--overwrite", "--quiet", *words]
    before = os.times()
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    after = os.times()
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    with h5py.File(folder / "out/result.h5") as file:
        found = {name: file["table"][name][()] for name in ("time", *(column for column, _ in COLUMNS))}
        found |= {name: float(file["summary"][name][()]) for name in ("largest_displacement", "rms_acceleration", "energy_residual")}
        found["steps"] = float(file["meta/steps"][()])
    found["cpu"] = after.children_user + after.children_system - before.children_user - before.children_system
    return found


def print_differences(found, before):
    """In rows of the same time, over the peak."""
    _, first, second = np.intersect1d(np.round(found["time"], 9), np.round(before["time"], 9), return_indices=True)
    for column, unit in COLUMNS:
        difference = found[column][first] - before[column][second]
        peak = np.abs(before[column]).max()
        print(f"{column:18} peak {peak:9.4g} {unit:5} largest difference {np.abs(difference).max() / peak:.1e}, "
              f"root mean square {np.sqrt(np.mean(difference**2)) / peak:.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--short", action="store_true", help=f"the first {SHORT:g} s alone")
    parser.add_argument("--before", type=Path, help="an earlier build, which runs the same")
    parser.add_argument("--set", action="append", default=[], help='"Section/Name=value", for all runs')
    arguments = parser.parse_args()
    seconds = SHORT if arguments.short else SECONDS
    changes = dict(re.split("=", words, maxsplit=1) for words in arguments.set)
    print_row(("build", "motion s", "CPU s", "ratio", "steps/s", "us/step", "largest z mm", "rms a mm/s^2", "energy left"), WIDTHS)
    results = []
    with tempfile.TemporaryDirectory(prefix="sprag-table-") as name:
        folder = Path(name)
        write_record(folder / "record.csv")
        for build, sprag in (("this", arguments.sprag), ("before", arguments.before)):
            if sprag is None:
                continue
            found = run(sprag, folder / "record.csv", seconds, changes, folder)
            results.append(found)
            print_row((build, f"{seconds:g}", f"{found['cpu']:.1f}", f"{found['cpu'] / seconds:.2f}", f"{found['steps'] / seconds:.0f}",
                       f"{1e6 * found['cpu'] / found['steps']:.0f}", f"{found['largest_displacement']:.3f}", f"{found['rms_acceleration']:.2f}",
                       f"{found['energy_residual']:.1e}"), WIDTHS)
    if len(results) == 2:
        print_differences(*results)


if __name__ == "__main__":
    main()
