# SPDX-License-Identifier: GPL-3.0-only
"""Builds sprag with the presets `debug` (assertions of the libraries) and `sanitize` (the same with the sanitizers for addresses,
leaks and undefined behaviour) and runs short scenes with both: none may abort, fail or be reported on. Run with /usr/bin/python3;
environment: SPRAG_SOURCE, the sources.

    tests/presets.py                  # both presets, every analysis and model
    tests/presets.py sanitize pair    # one preset, runs with `pair` in their name

By ctest, for which each run is a case (tests/presets.cmake.in):

    tests/presets.py --list              # the names of the runs, nothing else
    tests/presets.py --build sanitize    # no run
    tests/presets.py --run map sanitize  # the run of this name, without a build
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "support"))
import environment  # noqa: E402

SOURCE = Path(os.environ.get("SPRAG_SOURCE", Path(__file__).resolve().parents[1]))
PRESETS = ("debug", "sanitize")
LONGEST_RUN = 900  # s, beside other work

COARSE = ("Mesh/Face size=4", "Cylinder/Face size=4", "Analysis/Step=20", "Condensed/Modes=4")
# Without inertia over some steps each way; in time over a reversal.
SLIDE = ("Drive/Stroke=10", "Analysis/Step=5")
REVERSAL = ("Drive/Start=45", "Drive/Stroke=45.6", "Drive/Reversal duration=2e-3")
IN_TIME = ("Analysis/Type=transient",)
FEW_STEPS = ("Drive/Stroke=45.2", "Time/Step=2e-4", "Time/Tolerance=0")
MAP = ("Map/First points=3", "Map/Second points=2", "Map/Coarsest=1", "Map/Bisections=1", "Condensed/Modes=2")
ONSET = ("Sprag slip/Continuation=0", "Sprag slip/Settling time=0.02", "Sprag slip/Initial amplitude=1e-4", "Sprag slip/Steps per period=32")
STUDY = ("Study/Vary=Mesh/Degree = 1, 2; Mesh/Face size = 4, 300", "Study/Reference=Mesh/Face size = 3")

# Name: scene and what is changed in it.
RUNS = {
    "finite elements": ("model-a", SLIDE),
    "closed form": ("closed-form-b", SLIDE),
    "elastic cylinder": ("cylinder-a", SLIDE),
    "three dimensions": ("solid-tilted-a", (*SLIDE, "Mesh/Face size=8", "Mesh/Elements across=2")),
    "three dimensions, plate": ("solid-plate-a", (*SLIDE, "Mesh/Face size=8", "Mesh/Elements across=2", "Mesh/Degree=1")),
    "three dimensions, stability": ("solid-stability-a", ("Mesh/Face size=8", "Mesh/Elements across=2", "Condensed/Modes=6")),
    "three dimensions, reversal": ("solid-reversal-a", (*REVERSAL, "Mesh/Face size=8", "Mesh/Elements across=2", "Condensed/Modes=6")),
    "three dimensions, pair": ("solid-pair-a", (*SLIDE, "Mesh/Face size=8", "Mesh/Elements across=2", "Mesh/Degree=1")),
    "three dimensions, pair in time": (
        "solid-pair-a", (*REVERSAL, *IN_TIME, *FEW_STEPS, "Analysis/Model=condensed", "Mesh/Face size=8", "Mesh/Elements across=2", "Mesh/Degree=1")
    ),
    "slope": ("fig11", ("Slope/Number of points=5",)),
    "reversal, rigid": ("reversal-a", (*REVERSAL, "Analysis/Model=rigid")),
    "reversal, beam": ("reversal-a", REVERSAL),
    "reversal, condensed": ("reversal-a", (*REVERSAL, "Analysis/Model=condensed")),
    "reversal, finite elements": ("reversal-a", (*REVERSAL, "Analysis/Model=finite element", *FEW_STEPS)),
    "contact law": ("contact-law-a", ()),
    "modal": ("modal-a", ("Stability/Modes=3",)),
    "stability": ("stability-a", ("Stability/Critical=Lever/Depth 5 8", "Stability/Modes=3")),
    "map": ("map-position-depth-a", MAP),
    "study": ("study-a", (*SLIDE, *STUDY)),
    "sprag slip": ("onset-a", ONSET),
    "calibration": ("calibration-a", ("Mesh/Face size=8", "Mesh/Degree=1")),
    "full pair": ("pair-a", SLIDE),
    "full pair, reversal": ("pair-reversal-a", (*REVERSAL, *FEW_STEPS)),
}


def build(preset):
    began = time.monotonic()
    subprocess.run(["cmake", "--preset", preset], cwd=SOURCE, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", f"build-{preset}", "--target", "sprag"], cwd=SOURCE, check=True, stdout=subprocess.DEVNULL)
    print(f"{preset}: built in {time.monotonic() - began:.0f} s", flush=True)


def run(preset, scene, changes, folder):
    """Returns the problem of the run, empty without one."""
    command = [SOURCE / f"build-{preset}" / "sprag", SOURCE / "params" / f"{scene}.prm"]
    command += ["--output", f"{folder}/output", "--overwrite", "--quiet", "--jobs", "2"]
    for change in (*COARSE, *changes):
        command += ["--set", change]
    settings = {**environment.make_environment(SOURCE / f"build-{preset}"), "XDG_CACHE_HOME": folder}
    try:
        done = subprocess.run(
            list(map(str, command)), env=settings, capture_output=True, text=True, errors="replace", check=False, timeout=LONGEST_RUN
        )
    except subprocess.TimeoutExpired:
        return f"longer than {LONGEST_RUN} s"
    # --quiet: whatever is printed is an error or a report.
    if (done.returncode, done.stdout, done.stderr) == (0, "", ""):
        return ""
    return f"exit status {done.returncode}\n{done.stdout}{done.stderr}"


def runs_cpu_time():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def parsed(arguments):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--build", action="store_true")
    parser.add_argument("--run")
    parser.add_argument("words", nargs="*")
    return parser.parse_args(arguments)


def main(arguments):
    options = parsed(arguments)
    runs = RUNS
    presets = [preset for preset in PRESETS if preset in options.words] or PRESETS
    words = [word for word in options.words if word not in PRESETS]
    if options.run:
        runs = {options.run: runs[options.run]}
    elif options.build:
        runs = {}
    elif words:
        runs = {name: run for name, run in runs.items() if any(word in name for word in words)}
    if options.list:
        print("\n".join(runs))
        return 0
    failed = 0
    for preset in presets:
        if not options.run:
            build(preset)
        for name, (scene, changes) in runs.items():
            began, cpu = time.monotonic(), runs_cpu_time()
            with tempfile.TemporaryDirectory(prefix="sprag-test-") as folder:
                wrong = run(preset, scene, changes, folder)
            took = f"{time.monotonic() - began:.1f} s, {runs_cpu_time() - cpu:.1f} s of CPU"
            print(f"{preset}: {name}: {'FAILED' if wrong else 'passed'} in {took}", flush=True)
            if wrong:
                failed += 1
                print(wrong, flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
