#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints what runs in three dimensions cost by size, phase and number of processes, and the growth from size to size. See
solid-cost.md."""

import argparse
import math
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import h5py
from runs import ROOT, add_program, print_row

# Face size [mm] and elements across of the whole tilted lever of model A.
MESHES = {"63k": (2, 4), "248k": (1, 10), "400k": (1, 16), "890k": (0.5, 20), "1M": (0.5, 23)}
PHASES = ("body", "model", "steps_and_output", "exactness", "accuracy")
HEADS = ("mesh", "ranks", "dofs", "wall s", "CPU s", *("body", "face", "steps", "exact", "errors"), "GB", "growth")
WIDTHS = (6, 6, 9, 8, 8, 8, 8, 8, 8, 8, 7, 8)
ENVIRONMENT = {
    **os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}


def measure(sprag, scene, mesh, ranks, folder):
    face_size, across = MESHES[mesh]
    command = ["mpirun", "-n", ranks] if ranks > 1 else []
    command += [sprag, ROOT / "params" / scene, "--output", folder / "out", "--overwrite", "--quiet"]
    command += ["--set", f"Mesh/Face size={face_size}", "--set", f"Mesh/Elements across={across}"]
    before, start = os.times(), time.monotonic()
    done = subprocess.run(list(map(str, command)), env=ENVIRONMENT, capture_output=True, text=True, check=False)
    wall, after = time.monotonic() - start, os.times()
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    with h5py.File(folder / "out/result.h5") as file:
        meta = {name: float(file["meta"][name][()]) for name in ("degrees_of_freedom", "peak_memory")}
        phases = [float(file["meta"][f"cpu_time_{phase}"][()]) if f"cpu_time_{phase}" in file["meta"] else 0 for phase in PHASES]
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return meta["degrees_of_freedom"], wall, cpu, phases, meta["peak_memory"] / 1000


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_program(parser)
    parser.add_argument("--scene", default="solid-tilted-a.prm", help="of params/, in three dimensions")
    parser.add_argument("--meshes", nargs="+", choices=MESHES, default=list(MESHES))
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    arguments = parser.parse_args()
    folder = Path(tempfile.mkdtemp())
    print_row(HEADS, WIDTHS)
    try:
        for ranks in arguments.ranks:
            last = None
            for mesh in arguments.meshes:
                dofs, wall, cpu, phases, memory = measure(arguments.sprag, arguments.scene, mesh, ranks, folder)
                growth = f"{math.log(cpu / last[1]) / math.log(dofs / last[0]):.2f}" if last else ""
                cells = [mesh, str(ranks), f"{dofs:.0f}", f"{wall:.1f}", f"{cpu:.1f}", *(f"{phase:.1f}" for phase in phases)]
                print_row([*cells, f"{memory:.2f}", growth], WIDTHS)
                last = dofs, cpu
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
