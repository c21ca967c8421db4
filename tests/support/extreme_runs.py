# SPDX-License-Identifier: GPL-3.0-only
"""Reads the results of a run for tests/robustness/extremes.py and compares them."""

import re

import h5py
import numpy as np

# A run cannot have them: stresses without a mesh, what is found of a ringing that is none, slopes over too few rows, the way back of
# a run that stops before it. /accuracy says in words why it tells no number.
MAY_BE_NAN = re.compile(r"largest_\w*stress\w*|reversal_\d+_\w+|(representative_)?slope_\w+|deviation_\w+|largest_pressure\w*")
OF_A_STEP = ("step", "time_step", "iterations", "augmentations", "rejected_steps")  # the first row ends none
ALWAYS = ("time", "x", "v", "P", "Q", "F", "theta", "friction_work", "drive_work")


class Run:
    def __init__(self, status, message, path):
        self.status = status
        self.message = " ".join(re.sub(r"(?m)^ *\d+ %.*$", "", message).split())
        self.summary, self.accuracy, self.table, self.face, self.warnings = {}, {}, {}, {}, []
        if path.exists():
            with h5py.File(path, "r") as file:
                self.summary = values(file, "summary")
                self.accuracy = values(file, "accuracy")
                self.table = values(file, "table")
                self.face = values(file, "face")
                self.warnings = list(file.get("warnings", ()))

    @property
    def reason(self):
        """The message's first sentence, without the program's name and the scene's."""
        text = re.sub(r"^(sprag|--set|\S+\.prm(:\d+)?): ", "", self.message)
        return re.split(r"\. (?=[A-Z])", text)[0]

    def count(self, name):
        return self.summary.get(name)

    def values_that_are_no_numbers(self):
        faults = [f"summary/{n} = {v}" for n, v in self.summary.items() if is_bad(v) and not MAY_BE_NAN.fullmatch(n)]
        faults += [f"face/{n} has values that are no numbers" for n, v in self.face.items() if not np.isfinite(v).all()]
        touched = self.table["P"] > 0 if "P" in self.table else None
        for name, column in self.table.items():
            if np.isinf(column).any() or (name in ALWAYS and np.isnan(column).any()):
                faults.append(f"table/{name} has values that are no numbers")
            if np.isnan(column).all() or touched is None or name.endswith(("_closed_form", "_quasi_static")):
                continue
            looked_at = column[1:] if name in OF_A_STEP else column[touched]
            if np.isnan(looked_at).any():
                faults.append(f"table/{name} is NaN in {np.isnan(looked_at).sum()} rows in contact")
        return faults

    def estimated_error(self, names):
        return max((self.accuracy.get(name, np.nan) for name in names), default=np.nan)


def values(file, group):
    read = {name: data[()] for name, data in file.get(group, {}).items()}
    return {name: value.decode() if isinstance(value, bytes) else value for name, value in read.items()}


def is_bad(value):
    return isinstance(value, (float, np.floating)) and not np.isfinite(value)


def off(value, reference):
    return abs(value - reference) / abs(reference)


PEAKS = ("peak_P_forward", "peak_Q_forward", "peak_P_backward", "peak_Q_backward")


def peaks(*other, names=PEAKS, scale=1.0):
    """Largest difference from another run's numbers of the summary, times a factor."""

    def check(run, make):
        reference = make(*other)
        compared = [name for name in names if reference.summary.get(name)]
        return max(off(run.summary[name], scale * reference.summary[name]) for name in compared), np.nan

    return check


def forces(*other, scale=1.0, length=1.0):
    """Largest difference of P and Q from another run's, times a factor at x times another, over their peaks, without the passages
    through stick. Told are both runs' errors, twice, as what is told may be half of the true one."""

    def check(run, make):
        reference = make(*other)
        estimate = 2 * (run.estimated_error("PQ") + np.nan_to_num(reference.estimated_error("PQ")))
        worst = 0.0
        for name in "PQ":
            peak = np.abs(reference.table[name]).max()
            for sign in (1.0, -1.0):
                (x, mine), (its_x, its) = way(run, sign, name, length), way(reference, sign, name)
                its_x = length * its_x
                if len(x) and len(its_x) > 1:
                    inside = (x >= its_x.min()) & (x <= its_x.max())
                    worst = max(worst, np.abs(mine - scale * joined(its_x, its, x))[inside].max() / (scale * peak))
        return worst, estimate

    return check


def joined(x, y, at):
    """Cubics between samples, their slopes by differences."""
    order = np.argsort(x)
    x, y = x[order], y[order]
    slope = np.gradient(y, x)
    i = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    h = x[i + 1] - x[i]
    t = (at - x[i]) / h
    return (
        y[i] * (1 + 2 * t) * (1 - t) ** 2
        + y[i + 1] * t**2 * (3 - 2 * t)
        + h * slope[i] * t * (1 - t) ** 2
        - h * slope[i + 1] * t**2 * (1 - t)
    )


def deviation(run, _):
    """From the closed form beside it, of P and Q on both strokes."""
    return max(abs(value) for name, value in run.summary.items() if re.fullmatch(r"deviation_[PQ]_\w+", name)), np.nan


def peak_deviation(run, _):
    """From the closed form beside it, of the summary's peaks of P."""
    P, v = run.table["P_closed_form"], run.table["v"]
    ways = {"forward": P[v > 0].max(), "backward": P[v < 0].max()}
    return max(off(run.summary[f"peak_P_{way}"], value) for way, value in ways.items()), np.nan


def loop_area(*other):
    def check(run, make):
        return off(run.summary["loop_area"], make(*other).summary["loop_area"]), 2 * run.estimated_error(["loop_area"])

    return check


def numbers(expected):
    def check(run, _):
        return max(off(run.summary[name], value) for name, value in expected.items()), np.nan

    return check


def equal_rows(*other, columns=("x", "P", "Q", "theta"), scales=None):
    """Row by row, over each column's peak."""

    def check(run, make):
        reference = make(*other)
        worst = 0.0
        for name in columns:
            factor = (scales or {}).get(name, 1.0)
            a, b = run.table[name], factor * reference.table[name]
            if a.shape != b.shape:
                return np.inf, np.nan
            worst = max(worst, np.abs(a - b).max() / np.abs(b).max())
        return worst, np.nan

    return check


def pressure(*other, beyond):
    """The largest pressure on the way where x > `beyond`, over what it is there in another run."""

    def check(run, make):
        reference = make(*other)
        worst = 0.0
        for sign in (1.0, -1.0):
            (x, mine), (its_x, its) = (way(r, sign, "largest_pressure") for r in (run, reference))
            there = joined(its_x, its, x)
            worst = max(worst, (np.abs(mine - there) / there)[x > beyond].max())
        return worst, np.nan

    return check


def way(run, sign, name, length=1.0):
    """x and a column on one stroke, without the passage through stick."""
    x, v, column = (run.table[name] for name in ("x", "v", name))
    kept = (sign * v > 0) & (column != 0) & ((x < x.max() - 2 * length) if sign < 0 else True)
    return x[kept], column[kept]


def quasi_static_in_time(begin=0.0, end=1.0):
    """P in time from what it is without inertia, over its peak, where both slide: outside of the given shares of time."""

    def check(run, _):
        t, P, slow = (run.table[name] for name in ("time", "P", "P_quasi_static"))
        kept = (t < begin * t[-1]) | (t > end * t[-1])
        return np.abs(P - slow)[kept].max() / slow.max(), np.nan

    return check


def closes(run, _):
    """The last but one cycle, as the last ends without a turn, from one after a tenth of the run; P and Q over their peaks."""
    t, x = run.table["time"], run.table["x"]
    starts = np.flatnonzero(x == x.min())
    early = len(starts) // 10
    one, two = slice(starts[early], starts[early + 1] + 1), slice(starts[-3], starts[-2] + 1)
    worst = 0.0
    for name in ("P", "Q"):
        column = run.table[name]
        before = np.interp(t[two] - t[two][0], t[one] - t[one][0], column[one])
        worst = max(worst, np.abs(column[two] - before).max() / np.abs(column).max())
    return worst, np.nan
