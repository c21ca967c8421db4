#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Makes of a run what a test rig would have measured: time, x, P and Q at equal times, with noise.

Identification (params/identification.md) reads the table. One plans a measurement so: how much noise does it bear?
"""

import sys
from pathlib import Path

import numpy as np

from arguments import make_parser, script
from sprag.results import NotAResult, read_result

COLUMNS = {"time": "s", "x": "mm", "P": "N", "Q": "N"}


def measured(result, rate, noise, correlation, seed):
    """{column: values}; noise of this standard deviation [N], correlated from a row to the next."""
    for name in COLUMNS:
        if not result.has(name):
            raise NotAResult(f"{result.folder}: its table has no {name}")
    time = result.table["time"]
    at = np.arange(time[0], time[-1], 1 / rate)
    table = {"time": at, **{name: np.interp(at, time, result.table[name]) for name in ("x", "P", "Q")}}
    generator = np.random.default_rng(seed)
    for name in ("P", "Q"):
        steps = generator.normal(0, noise, len(at)) * np.where(np.arange(len(at)) > 0, np.sqrt(1 - correlation**2), 1)
        for row in range(1, len(at)):
            steps[row] += correlation * steps[row - 1]
        table[name] = table[name] + steps
    return table


def write(table, path):
    rows = np.column_stack([table[name] for name in COLUMNS])
    header = ", ".join(f"{name} [{unit}]" for name, unit in COLUMNS.items())
    np.savetxt(path, rows, fmt=("%.6g", "%.6g", "%.5g", "%.5g"), delimiter=", ", header=header, comments="")


@script
def main(arguments=None):
    parser = make_parser(__doc__)
    parser.add_argument("folder", type=Path, help="result folder of a run along a drive")
    parser.add_argument("-o", "--output", required=True, help="CSV file to write")
    parser.add_argument("--rate", type=float, default=500.0, help="rows a second (default 500)")
    parser.add_argument("--noise", type=float, default=0.1, help="standard deviation of P and Q [N] (default 0.1)")
    parser.add_argument("--correlation", type=float, default=0.0, help="of the noise from a row to the next (default 0)")
    parser.add_argument("--seed", type=int, default=1, help="of the noise (default 1)")
    options = parser.parse_args(arguments)
    if not (options.rate > 0 and options.noise >= 0 and 0 <= options.correlation < 1):
        parser.error("--rate must be > 0, --noise >= 0, --correlation >= 0 and < 1")
    write(measured(read_result(options.folder), options.rate, options.noise, options.correlation, options.seed), options.output)


if __name__ == "__main__":
    sys.exit(main())
