# SPDX-License-Identifier: GPL-3.0-only
"""Runs of sprag that the other scripts here measure."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def add_program(parser):
    """The option --sprag; default $SPRAG or build/sprag."""
    default = Path(os.environ.get("SPRAG", ROOT / "build" / "sprag"))
    parser.add_argument("--sprag", type=Path, default=default, help="the program; default $SPRAG or build/sprag")


def run_scene(sprag, scene, changes, output, *options):
    """Runs a scene of params/ with {parameter: value} changed, linear algebra on one thread; RuntimeError with its message if it fails."""
    command = [Path(sprag).resolve(), ROOT / "params" / scene, "--output", output, "--quiet", *options]
    for name, value in changes.items():
        command += ["--set", f"{name}={value}"]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{scene}: {done.stderr.strip()}")


def measure_cpu(work):
    """Returns what the work gives, and the CPU time of the processes that it starts."""
    before = os.times()
    result = work()
    after = os.times()
    return result, after.children_user + after.children_system - before.children_user - before.children_system


def print_row(cells, widths):
    """The first cell to the left, the others to the right; a width of 0 ends the line with the cell as it is."""
    line = cells[0].ljust(widths[0])
    for cell, width in zip(cells[1:], widths[1:]):
        line += cell.rjust(width) if width else "  " + cell
    print(line, flush=True)
