#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Runs every scene of params/, long ones shortened, with two builds of sprag and prints a line a scene: how far results differ and
what both cost. Exit status 1 where P, Q or theta differ by more than 1e-9 (--limit) of their peak or a verdict differs. With --speed, only
what both builds cost, over a fixed list of runs. See README.md.

    tests/benchmarks/compare.py OLD NEW [--scenes WORD...]
    tests/benchmarks/compare.py OLD NEW --speed [--repeats 3] [--scenes WORD...]
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
LIMIT = 1e-9  # of the peak
CHAOTIC_SHARE = 0.2  # of the rows of a vibration that never loses contact

# Shortened to a few seconds: the longest first word that a scene's name begins with counts.
STEPS = ("Analysis/Step=2",)
REVERSAL = ("Drive/Start=58", "Drive/Stroke=60")
MAP = ("Map/First points=5", "Map/Second points=4", "Map/Coarsest=2", "Map/Bisections=1", "Condensed/Modes=8")
ONSET = ("Sprag slip/Continuation=1", "Sprag slip/Settling time=0.05", "Sprag slip/Initial amplitude=1e-4", "Sprag slip/Turn=64")
SHORTER = {
    "": (),
    "calibration-": ("Mesh/Face size=2",),
    "fig": ("Slope/Number of points=41",),
    "harmonic-": ("Drive/Stroke=10",),
    "map-": MAP,
    "neo-hookean-": ("Analysis/Step=20", "Mesh/Face size=2"),
    "onset-": ONSET,
    "pair-reversal-": REVERSAL,
    "pair-stability-": ("Stability/Critical=none",),
    "plate-reversal-": REVERSAL,
    "stability-": ("Stability/Critical=Lever/Depth 4 12",),
    "stiff-": ("Analysis/Step=5",),
}

STATIC = ("Output/Fields=none",)
IN_TIME = (*STATIC, "Time/Tolerance=0")
FEW_STEPS = ("Drive/Start=58", "Drive/Stroke=60", "Time/Step=2e-4")
NO_SEARCH = ("Stability/Critical=none", "Stability/Roles=off")
SPEED = {
    "start": ("closed-form-a", ()),
    "model A as shipped": ("model-a", ()),
    "quasi-static, penalty": ("model-a", STATIC),
    "quasi-static, augmented": ("augmented-lagrangian-a", STATIC),
    "elastic cylinder": ("cylinder-a", STATIC),
    "pair": ("pair-a", STATIC),
    "face size 0.0625": ("model-a", (*STATIC, "Mesh/Face size=0.0625", "Analysis/Step=10")),
    "beam in time": ("reversal-a", (*IN_TIME, "Time/Step=5e-6")),
    "condensed in time": ("reversal-a", (*IN_TIME, "Analysis/Model=condensed", "Time/Step=1e-4")),
    "finite elements in time": ("reversal-a", (*IN_TIME, "Analysis/Model=finite element", *FEW_STEPS)),
    "pair in time": ("pair-reversal-a", (*IN_TIME, "Analysis/Model=condensed", *FEW_STEPS)),
    "eigenvalues": ("stability-a", (*STATIC, "Analysis/Model=finite element", *NO_SEARCH)),
    "solid A as shipped": ("solid-a", ()),
    "study of beams": ("study-reversal-a", ("Analysis/Model=beam", "Study/Reference=", "Study/Vary=Lever/Depth = 15 ... 25 : 250")),
    "frequencies": ("study-transmissibility-a", ("Study/Vary=Isolation/Base frequency = 0.2 ... 4 : 200 log", "Isolation/Damper=lever")),
    "random base, condensed": ("isolation-ground-a", ("Analysis/Model=condensed", "Isolation/Duration=10")),
    "map": ("map-friction-depth-a", ("Map/First points=30", "Map/Second points=30", "Map/Coarsest=1", "Map/Bisections=0")),
}

COUNTED = re.compile(r"(P|Q|theta)(_2|_0|_beam|_fitted|_forward|_backward)?")
KINDS = ("P", "Q", "theta", "growth", "frequency", "other")


class Run:
    """Holds the result and the cost of a scene run by one build."""

    def __init__(self, program, scene, changes, folder):
        command = [program, ROOT / "params" / f"{scene}.prm"]
        command += ["--output", folder / "output", "--overwrite", "--quiet", "--jobs", "1"]
        for change in changes:
            command += ["--set", change]
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "XDG_CACHE_HOME": str(folder / "cache")}
        with open(folder / "messages", "w", encoding="utf-8") as messages:
            with subprocess.Popen(list(map(str, command)), env=environment, stdout=messages, stderr=messages) as process:
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
        self.cpu = usage.ru_utime + usage.ru_stime
        self.status = process.returncode
        self.message = (folder / "messages").read_text(encoding="utf-8", errors="replace").strip()
        self.file = folder / "output" / "result.h5"


def read_results(path):
    """{group/name: numbers or text}, without what a run cost."""
    found = {}
    with h5py.File(path, "r") as file:

        def keep(name, item):
            if isinstance(item, h5py.Dataset) and not name.startswith(("meta/", "parameters")):
                value = item[()]
                if item.dtype.kind in "OS":
                    found[name] = b"\n".join(np.atleast_1d(value)).decode()
                else:
                    found[name] = np.asarray(value, dtype=float)

        file.visititems(keep)
    return found


def calm_rows(table, summary):
    """Returns the number of rows to compare, None for all. Two runs in time drift apart after they lose contact."""
    P, time = table.get("table/P"), table.get("table/kinetic_energy")
    if P is None or time is None or not np.any(np.nan_to_num(time) > 0):
        return None
    touched = np.maximum.accumulate(P > 0)
    lost = np.flatnonzero(touched & ~(P > 0))
    if lost.size:
        return int(lost[0])
    texts = [value for value in summary.values() if isinstance(value, str)]
    return int(CHAOTIC_SHARE * P.size) if {"vibrates", "limit cycle"} & set(texts) else None


def difference(old, new):
    """Largest difference over the peak; infinite where one is a number and the other is none."""
    if old.shape != new.shape or np.any(np.isfinite(old) != np.isfinite(new)):
        return np.inf
    finite = np.isfinite(old)
    if not finite.any():
        return 0.0
    off = np.max(np.abs(old[finite] - new[finite]))
    return off / max(np.max(np.abs(old[finite])), np.finfo(float).tiny) if off > 0 else 0.0


def at_same_places(new, old_x, new_x):
    """Values of rows where the old build has them, by their slope over x: a build that rounds otherwise puts the steps of a passage
    through stick elsewhere, by 1e-9 of x."""
    if old_x.shape != new_x.shape or new.shape != new_x.shape or new.size < 2 or not np.any(new_x != old_x):
        return new
    along = np.gradient(new_x)
    slope = np.divide(np.gradient(new), along, out=np.zeros_like(new), where=along != 0)
    return new - slope * (new_x - old_x)


def find_kind(name, tables_count):
    group, _, column = name.partition("/")
    if found := COUNTED.fullmatch(column):
        return found[1]
    if group == "table" and tables_count:
        return "P"
    return next((kind for kind in ("growth", "frequency") if kind in column), "other")


def compare(old, new):
    """Largest difference of each kind, differing texts, rows compared."""
    worst, texts = dict.fromkeys(KINDS, 0.0), []
    names = {name for name in (*old, *new) if not name.startswith("warnings/")}
    tables_count = not any(COUNTED.fullmatch(name.partition("/")[2]) for name in names)
    rows = calm_rows(old, {name: value for name, value in old.items() if name.startswith("summary/")})
    for name in sorted(names):
        if name not in old or name not in new:
            texts.append(f"{name} only in {'old' if name in old else 'new'}")
        elif isinstance(old[name], str) or "kind" in name:
            if str(old[name]) != str(new[name]):
                texts.append(f"{name}: {old[name]} / {new[name]}".replace("\n", " "))
        else:
            chosen = slice(rows) if name.startswith("table/") else slice(None)
            pair = [value[chosen] if value.ndim else value for value in (old[name], new[name])]
            kind = find_kind(name, tables_count)
            if kind in ("P", "Q", "theta") and name.startswith("table/") and "table/x" in old:
                pair[1] = at_same_places(pair[1], old["table/x"][chosen], new["table/x"][chosen])
            if rows is None or name.startswith("table/") or kind in ("growth", "frequency"):
                worst[kind] = max(worst[kind], difference(*pair))
    return worst, texts, rows


def line(name, cells):
    return name.ljust(26) + "".join(str(cell).rjust(10) for cell in cells)


def speed(old, new):
    return [f"{old:.2f}", f"{new:.2f}", f"{old / new:.2f}"]


def compare_scene(arguments, scene, folder):
    begin = max((begin for begin in SHORTER if scene.startswith(begin)), key=len)
    runs = []
    for build in ("old", "new"):
        (folder / build).mkdir(parents=True)
        runs.append(Run(getattr(arguments, build), scene, SHORTER[begin], folder / build))
    old, new = runs
    if not (old.file.exists() and new.file.exists()):
        print(line(scene, [old.status, new.status]), f"FAILED: no result: {old.message or new.message}", flush=True)
        return False
    worst, texts, rows = compare(read_results(old.file), read_results(new.file))
    if (old.status, old.message) != (new.status, new.message):
        texts.append(f"exit status {old.status} / {new.status}: {new.message or old.message}")
    failed = bool(texts) or any(not worst[kind] <= arguments.limit for kind in ("P", "Q", "theta"))
    remark = "" if rows is None else f" chaotic: the first {rows} rows"
    remark += f" FAILED {'; '.join(texts)}" if failed else ""
    print(line(scene, [f"{worst[kind]:.0e}" for kind in KINDS] + speed(old.cpu, new.cpu)) + remark, flush=True)
    return not failed


def compare_speed(arguments, name, folder):
    scene, changes = SPEED[name]
    costs = {"old": [], "new": []}
    for _ in range(arguments.repeats):
        for build, seconds in costs.items():
            (folder / build).mkdir(parents=True, exist_ok=True)
            run = Run(getattr(arguments, build), scene, changes, folder / build)
            if run.status != 0:
                print(f"{name}: {build}: {run.message}", flush=True)
                return False
            seconds.append(run.cpu)
    print(line(name, speed(*(min(seconds) for seconds in costs.values()))), flush=True)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--scenes", nargs="+", default=[""], help="only those with one of these words in their name")
    parser.add_argument("--speed", action="store_true", help="what a fixed list of runs costs, results aside")
    parser.add_argument("--repeats", type=int, default=3, help="of each run of --speed, old and new in turn; the least counts")
    parser.add_argument("--limit", type=float, default=LIMIT, help="of P, Q and theta over their peaks")
    arguments = parser.parse_args()
    arguments.old, arguments.new = arguments.old.resolve(), arguments.new.resolve()

    names = SPEED if arguments.speed else [path.stem for path in sorted((ROOT / "params").glob("*.prm"))]
    names = [name for name in names if any(word in name for word in arguments.scenes)]
    print(line("run" if arguments.speed else "scene", ([] if arguments.speed else list(KINDS)) + ["old s", "new s", "speed"]))
    act = compare_speed if arguments.speed else compare_scene
    passed = []
    with tempfile.TemporaryDirectory(prefix="sprag-compare-") as folder:
        for number, name in enumerate(names):
            passed.append(act(arguments, name, Path(folder) / str(number)))
    print(f"{passed.count(False)} of {len(passed)} failed")
    return 0 if passed and all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
