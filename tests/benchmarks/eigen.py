#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what the eigenvalues of a slide cost: wall and CPU time of making the model and of finding the slide and its vibrations, for
beam, condensed lever and finite elements of two sizes, and ratios of the CPU times. Run it on a machine that does nothing else;
see in-time.md."""

import argparse
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, print_row, run_scene

ROOT = Path(__file__).resolve().parents[2]
MAKING = ("mesh", "basis", "model")
COLUMNS = ("model", "face mm", "DOF", "coordinates", "model wall", "model CPU", "eigen wall", "eigen CPU", "growth 1/s", "Hz",
           "residual", "MiB", "eigen / beam", "/ finite element")
WIDTHS = (16, 9, 8, 13, 12, 11, 12, 11, 12, 9, 10, 6, 14, 18)

# Model, face size [mm]. About 14 000 and 50 000 degrees of freedom.
RUNS = (
    ("beam", 0.5),
    ("condensed", 0.5),
    ("finite element", 0.5),
    ("condensed", 0.16),
    ("finite element", 0.16),
)


def total(meta, kind, phases):
    names = [f"{kind}_time_{phase}" for phase in phases]
    return sum(meta[name][()] for name in names if name in meta)


def run(sprag, scene, model, face_size, modes, output):
    changes = {
        "Analysis/Model": model,
        "Mesh/Face size": face_size,
        "Condensed/Cache": output.with_suffix(".cache"),
        "Stability/Roles": "off",
        "Stability/Critical": "none",
        "Stability/Modes": modes,
        "Output/Fields": "none",
    }
    try:
        run_scene(sprag, scene, changes, output)
    except RuntimeError as failure:
        return str(failure)
    with h5py.File(output / "result.h5", "r") as file:
        meta, summary = file["meta"], file["summary"]
        return {
            "model": model,
            "face mm": face_size if "coordinates" in meta else np.nan,
            "DOF": meta["degrees_of_freedom"][()] if "coordinates" in meta else np.nan,
            "coordinates": meta["coordinates"][()] if "coordinates" in meta else np.nan,
            "model wall": total(meta, "wall", MAKING),
            "model CPU": total(meta, "cpu", MAKING),
            "eigen wall": meta["wall_time_eigenvalues"][()],
            "eigen CPU": meta["cpu_time_eigenvalues"][()],
            "growth 1/s": summary["growth_rate"][()],
            "Hz": summary["frequency"][()],
            "residual": file["modes"]["residual"][:].max(),
            "MiB": meta["peak_memory"][()],
        }


def text(value):
    if isinstance(value, str):
        return value
    if np.isnan(value):
        return "-"
    if value == round(value):
        return f"{value:.0f}"
    return f"{value:.2e}" if abs(value) < 1e-3 else f"{value:.4g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--scene", type=Path, default=ROOT / "params" / "stability-a.prm")
    parser.add_argument("--modes", type=int, default=10)
    options = parser.parse_args()

    print_row(COLUMNS, WIDTHS)
    beam, elements, failed = np.nan, {}, 0
    rows = []
    with tempfile.TemporaryDirectory(prefix="sprag-eigen-") as folder:
        for i, (model, face_size) in enumerate(RUNS):
            row = run(options.sprag.resolve(), options.scene, model, face_size, options.modes, Path(folder) / str(i))
            if isinstance(row, str):
                print(f"{model}, {face_size} mm: {row}", file=sys.stderr)
                failed += 1
                continue
            rows.append((face_size, row))
            if model == "beam":
                beam = row["eigen CPU"]
            if model == "finite element":
                elements[face_size] = row["eigen CPU"]
    for face_size, row in rows:
        row["eigen / beam"] = row["eigen CPU"] / beam
        row["/ finite element"] = row["eigen CPU"] / elements.get(face_size, np.nan)
        print_row([text(row[column]) for column in COLUMNS], WIDTHS)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
