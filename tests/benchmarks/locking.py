#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Prints how well a friction layer that hardly changes its volume is met: model A with Coefficient 0 in plane strain at x = 65 mm,
against the same layer bonded to a rigid base, whose compliance is exact mode by mode (tests/verification/bonded_layer.py), pressed
by the same force. See parts.md.

    tests/benchmarks/locking.py [PROGRAM]     # build/sprag if not given"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification"))
import bonded_layer  # pylint: disable=wrong-import-position

RADIUS, MODULUS, THICKNESS, WIDTH = 56.0, 20.0, 1.0, 40.0
RATIOS = (0.0, 0.3, 0.45, 0.49, 0.499, 0.4999)
SIZES = (1.0, 0.5, 0.25)


def run(sprag, nu, degree, size, penalty, folder):
    """Force per width, indentation, contact width and largest pressure."""
    values = {
        "Analysis/Plane": "strain", "Friction/Law": "Coulomb", "Friction/Coefficient": 0, "Drive/Cycles": 0.5,
        "Friction layer/Poisson's ratio": nu, "Mesh/Degree": degree, "Mesh/Face size": size, "Contact/Penalty": penalty,
        "Analysis/Step": 13, "Output/Fields": "none",
    }
    command = [str(sprag), str(ROOT / "params" / "model-a.prm"), "--output", folder, "--quiet", "--overwrite"]
    for name, value in values.items():
        command += ["--set", f"{name}={value}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stderr.strip()}")
    with h5py.File(Path(folder) / "result.h5", "r") as file:
        last = lambda name: float(file["table"][name][-1])
        return last("P") / WIDTH, last("indentation"), last("contact_width"), float(file["face/pressure"][-1].max())


def exact(nu, force):
    """The same three of the layer on a rigid base under `force` per width."""
    half_width, indentation, _, pressure = bonded_layer.solve(force * RADIUS / (MODULUS * THICKNESS**2), 0.0,
                                                              *bonded_layer.kernels(nu))
    return (indentation * THICKNESS**2 / RADIUS, 2.0 * half_width * THICKNESS, pressure * MODULUS * THICKNESS / RADIUS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sprag", nargs="?", type=Path, default=ROOT / "build" / "sprag")
    parser.add_argument("--penalty", default="auto", help="Contact/Penalty [N/mm3]")
    arguments = parser.parse_args()
    print("deviation from the exact layer in %: indentation | contact width | largest pressure")
    print("     nu   exact: mm     mm    MPa   degree " + "".join(f"{f'size {size} mm':>27}" for size in SIZES))
    with tempfile.TemporaryDirectory() as folder:
        for nu in RATIOS:
            for degree in (1, 2):
                found = [run(arguments.sprag, nu, degree, size, arguments.penalty, folder) for size in SIZES]
                expected = exact(nu, found[-1][0])
                cells = ""
                for _, *values in found:
                    cells += "   " + " |".join(f"{100.0 * (v / e - 1.0):7.2f}" for v, e in zip(values, expected))
                print(f"{nu:7}   {expected[0]:9.5f} {expected[1]:6.3f} {expected[2]:6.4f} {degree:8} {cells}", flush=True)


if __name__ == "__main__":
    main()
