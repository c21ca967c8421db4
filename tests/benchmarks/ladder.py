#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what each fidelity of a run in time costs and how far it is from hard contact, in one table: model A with a lever of
6 mm, accepted steps per CPU second, no fields; then model A with 20 mm, whose ringing decays and can be compared. See in-time.md."""

import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, run_scene

# Ten times the automatic penalty on half the face size, in shorter steps.
HARD_CONTACT = {"Mesh/Face size": 0.25, "Contact/Penalty": 24000, "Time/Step": "2e-5"}
MODELS = ("closed form", "rigid", "beam", "condensed", "finite element")
COLUMNS = ("model", "coordinates", "steps", "steps/CPU s", "process s", "cost ratio", "frequency Hz", "error of P", "verdict")
WIDTHS = (16, 12, 8, 12, 10, 11, 13, 12, 10)


def run(sprag, scene, model, changes, output):
    run_scene(sprag, scene, {"Output/Fields": "none", "Analysis/Model": model, **changes}, output)
    with h5py.File(Path(output) / "result.h5", "r") as file:
        meta, summary, table = file["meta"], file["summary"], file["table"]
        verdict = summary["reversal_1_verdict"][()]
        return {
            "model": model,
            "coordinates": meta["coordinates"][()] if "coordinates" in meta else np.nan,
            "steps": summary["steps"][()],
            "rate": meta["steps_per_cpu_second"][()],
            "cpu": meta["cpu_time"][()],
            "frequency": summary["reversal_1_frequency"][()],
            "verdict": verdict.decode() if isinstance(verdict, bytes) else str(verdict),
            "time": table["time"][:],
            "P": table["P"][:],
        }


def result_error(result, hard):
    """Largest difference of P from hard contact over its peak."""
    difference = np.interp(result["time"], hard["time"], hard["P"]) - result["P"]
    return np.nanmax(np.abs(difference)) / hard["P"].max()


def print_table(title, results, hard):
    print(f"\n{title}\n" + "".join(name.rjust(width) for name, width in zip(COLUMNS, WIDTHS)))
    finest = results[-1]
    for result in results:
        cells = (
            result["model"],
            "-" if np.isnan(result["coordinates"]) else f"{result['coordinates']:.0f}",
            f"{result['steps']:.0f}",
            f"{result['rate']:.0f}",
            f"{result['cpu']:.2f}",
            f"{finest['rate'] / result['rate']:.4f}" if result["rate"] > 0 else "-",
            f"{result['frequency']:.1f}",
            f"{result_error(result, hard):.3g}",
            result["verdict"],
        )
        print("".join(cell.rjust(width) for cell, width in zip(cells, WIDTHS)), flush=True)
    print(f"hard contact: {hard['frequency']:.1f} Hz, {hard['verdict']}, {hard['steps']:.0f} steps, {hard['cpu']:.1f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--step", default="5e-5", help="Time/Step of all runs [s]")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="sprag-benchmark-") as folder:
        scenes = (
            ("Model A, lever of 6 mm, x = 45 ... 65 ... 45 mm", "sprag-slip-a.prm", {"Drive/Start": 45}),
            ("Model A, lever of 20 mm, x = 45 ... 65 ... 45 mm", "reversal-a.prm", {}),
        )
        for title, scene, changes in scenes:
            changes = {"Time/Step": arguments.step, **changes}
            hard = run(arguments.sprag, scene, "condensed", {**changes, **HARD_CONTACT}, folder)
            print_table(title, [run(arguments.sprag, scene, model, changes, folder) for model in MODELS], hard)


if __name__ == "__main__":
    main()
