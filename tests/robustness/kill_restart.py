# SPDX-License-Identifier: GPL-3.0-only
"""Runs that are killed go on from their checkpoint and end as if nothing had happened, to the last bit; results and checkpoints that
are of something else are refused, or begun anew and told. Run with /usr/bin/python3; environment: SPRAG, the program, and
SPRAG_SOURCE, the sources.

    kill_restart.py --kills 50 [--seed 1]    # kills so many runs of all kinds at random moments and prints a table"""

import argparse
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, SPRAG, TIMEOUT, RunTest, sets, sprag  # noqa: E402

QUASI_STATIC = {"Mesh/Face size": "2", "Analysis/Step": "0.5", "Drive/Stroke": "30", "Output/Fields": "interval"}
SOLID = {
    "Analysis/Dimension": "3", "Mesh/Face size": "4", "Mesh/Faces in contact": "0", "Mesh/Elements across": "2", "Cylinder/Tilt": "1e-4",
    "Drive/Stroke": "20", "Output/Fields": "interval", "Output/Field interval": "4",
}
IN_TIME = {"Drive/Start": "63.5", "Mesh/Face size": "4", "Time/Tolerance": "1e-3", "Output/Fields": "interval", "Output/Field interval": "0.5"}
REDUCED = {"Drive/Start": "62", "Time/Tolerance": "1e-6"}
TABLE = {"Isolation/Duration": "0.6", "Isolation/Output step": "2e-3"}
SPACE_IN_TIME = {"Mesh/Face size": "6", "Mesh/Elements across": "2", "Condensed/Modes": "6"}
CONDENSED = {**IN_TIME, "Analysis/Model": "condensed", "Condensed/Modes": "8"}
QUICK = {
    "quasi-static, penalty": ("model-a", QUASI_STATIC),
    "quasi-static, augmented": ("augmented-lagrangian-a", QUASI_STATIC),
    "three dimensions": ("model-a", SOLID),
    "in time, rigid": ("reversal-a", {**REDUCED, "Analysis/Model": "rigid"}),
    "in time, beam": ("reversal-a", REDUCED),
    "in time, condensed": ("reversal-a", CONDENSED),
    "in time, finite element": ("reversal-a", {**IN_TIME, "Analysis/Model": "finite element"}),
    "table on beams": ("isolation-free-a", {**TABLE, "Analysis/Model": "beam"}),
}
ALL = {
    **QUICK,
    "three dimensions in time": ("solid-reversal-a", {**SPACE_IN_TIME, "Drive/Start": "64.5"}),
    "parts in three dimensions in time": (
        "solid-plate-reversal-a",
        {**SPACE_IN_TIME, "Drive/Start": "64.5", "Lever/Outline": "bar", "Rotational spring/Type": "leaf", "Lever/Tip mass": "1e-5"},
    ),
    "accuracy asked for": ("model-a", {"Accuracy/Target": "0.05", "Drive/Stroke": "30", "Analysis/Step": "0.5"}),
    "neo-Hookean": ("neo-hookean-a", {"Mesh/Face size": "4", "Drive/Stroke": "6"}),
    "neo-Hookean in three dimensions": ("solid-neo-hookean-a", {"Mesh/Face size": "4", "Mesh/Elements across": "2", "Drive/Stroke": "6"}),
    "elastic cylinder": ("cylinder-a", {"Mesh/Face size": "4", "Drive/Stroke": "20", "Analysis/Step": "1"}),
    "pair without inertia": ("pair-a", {"Mesh/Face size": "4", "Drive/Stroke": "20", "Analysis/Step": "1"}),
    "pair in three dimensions": ("solid-pair-a", {"Mesh/Face size": "4", "Mesh/Elements across": "2", "Drive/Stroke": "15"}),
    "pair in three dimensions, in time": (
        "solid-pair-a",
        {**CONDENSED, "Analysis/Type": "transient", "Drive/Start": "64", "Mesh/Elements across": "2"},
    ),
    "plate without inertia": ("plate-a", {"Mesh/Face size": "4", "Drive/Stroke": "20", "Analysis/Step": "1"}),
    "support, beam": ("support-a", {"Drive/Start": "60"}),
    "support, finite element": ("support-a", {**IN_TIME, "Analysis/Model": "finite element"}),
    "pair, condensed": ("pair-reversal-a", CONDENSED),
    "pair, finite element": ("pair-reversal-a", {**IN_TIME, "Drive/Start": "64", "Analysis/Model": "finite element"}),
    "plate, condensed": ("plate-reversal-a", CONDENSED),
    "stick and slip": ("stribeck-a", {"Drive/Start": "53"}),
    "table on condensed levers": (
        "isolation-ground-a",
        {**TABLE, "Analysis/Model": "condensed", "Mesh/Face size": "4", "Condensed/Modes": "8", "Isolation/Highest frequency": "20",
         "Isolation/Spectrum lines": "300", "Isolation/Base acceleration": "500"},
    ),
    "table on finite elements": ("isolation-a", {**TABLE, "Analysis/Model": "finite element", "Mesh/Face size": "4", "Isolation/Duration": "0.1"}),
    "table on levers in three dimensions": ("solid-isolation-a", {**TABLE, **SPACE_IN_TIME, "Isolation/Duration": "0.2"}),
    "elastic cylinder in time": ("cylinder-a", {**CONDENSED, "Analysis/Type": "transient", "Drive/Start": "64"}),
}
# The cost and the origin of a run may differ.
ALLOWED = re.compile(r"meta/((cpu|wall)_time.*|peak_memory|steps_per_cpu_second|steps_taken_over|basis_from_cache|basis_cpu_time)")
OFTEN = {**os.environ, "SPRAG_CHECKPOINT_SECONDS": "0.02"}
ALWAYS = {**os.environ, "SPRAG_CHECKPOINT_SECONDS": "0"}


def arguments(scene, changes, output):
    return [SOURCE / "params" / f"{scene}.prm", "--output", output, *sets(changes)]


def content(path):
    """Bytes, shape and attributes of all there is in a file of HDF5 that may not differ; the bytes of any other."""
    if path.suffix != ".h5":
        return path.read_bytes()
    found = {}

    def note(name, item):
        attributes = {key: str(value) for key, value in item.attrs.items()}
        data = item[()] if isinstance(item, h5py.Dataset) else None
        values = data.tobytes() if isinstance(data, (np.ndarray, np.generic)) and data.dtype != object else repr(data)
        if not ALLOWED.fullmatch(name):
            found[name] = (getattr(item, "shape", None), attributes, values)

    with h5py.File(path, "r") as file:
        file.visititems(note)
    return found


def contents(folder):
    """Returns the contents of all files but the log, which has dates and times."""
    return {path.name: content(path) for path in sorted(folder.iterdir()) if path.name != "run.log"}


def differences(folder, expected):
    """Names of the files and data that are not alike, and the number of data compared."""
    found = contents(folder)
    unlike = sorted(set(found) ^ set(expected))
    compared = 0
    for name in set(found) & set(expected):
        if isinstance(found[name], dict):
            names = set(found[name]) | set(expected[name])
            unlike += [f"{name}:{data}" for data in sorted(names) if found[name].get(data) != expected[name].get(data)]
            compared += len(names)
        else:
            unlike += [name] if found[name] != expected[name] else []
            compared += 1
    return unlike, compared


def taken_over(folder):
    with h5py.File(folder / "result.h5", "r") as file:
        return int(file["meta/steps_taken_over"][()])


def find_worker(process):
    try:
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    except OSError:
        return None
    return int(children[0]) if children else None


class Victim:
    """A scene that is run to its end, and killed on the way in another folder."""

    def __init__(self, name, folder, chance, share):
        scene, changes = ALL[name]
        self.chance, self.share = chance, share
        self.whole, self.killed = folder / "whole", folder / "killed"
        self.command = [SPRAG, *map(str, arguments(scene, changes, self.killed)), "--quiet"]
        begin = time.monotonic()
        done = sprag(*arguments(scene, changes, self.whole), "--quiet")
        self.seconds = time.monotonic() - begin
        if done.returncode != 0:
            raise RuntimeError(f"{name}: {done.stderr}")
        self.expected = contents(self.whole)
        with h5py.File(self.whole / "result.h5", "r") as file:
            self.steps = len(file["table/time" if "table/time" in file else "table/x"]) - 1
        self.kills = self.ends = self.went_on = self.compared = 0
        self.unlike, self.said = [], []

    def stamp(self):
        """Tells one checkpoint from another."""
        try:
            status = os.stat(self.killed / "run.checkpoint")
        except OSError:
            return 0
        return status.st_mtime_ns

    def kill_once(self):
        """Starts or goes on, and kills at a random moment, some time after the start or some checkpoints: the program, its working
        process, or both at once by a signal that it notices. What ends before is compared, and another run begins."""
        environment = self.chance.choice((OFTEN, OFTEN, ALWAYS))
        kind = self.chance.choice(("program", "worker", "interrupt"))
        checkpoints = self.chance.randint(2, 8) if self.chance.random() < self.share else 0
        moment = self.chance.uniform(0, 0.2 if checkpoints else 1) * self.seconds
        process = subprocess.Popen(self.command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
        seen = {self.stamp()}
        while len(seen) <= checkpoints and process.poll() is None:
            seen.add(self.stamp())
            time.sleep(0.001)
        try:
            process.wait(moment)
        except subprocess.TimeoutExpired:
            victim = find_worker(process) if kind == "worker" else process.pid
            try:
                os.kill(victim or process.pid, signal.SIGTERM if kind == "interrupt" else signal.SIGKILL)
            except ProcessLookupError:
                pass
        said = process.communicate(timeout=TIMEOUT)[1]
        if process.returncode == 0:
            self.compare()
            return
        if process.returncode not in (1, -signal.SIGKILL):
            self.unlike.append(f"exit status {process.returncode}: {said}")
        self.kills += 1
        if "begins anew" in said:
            self.said.append(said)

    def end(self):
        done = subprocess.run(self.command, capture_output=True, text=True, check=False, timeout=TIMEOUT, env=OFTEN)
        if done.returncode != 0 or done.stderr:
            self.unlike.append(f"exit status {done.returncode}: {done.stderr}")
        else:
            self.compare()

    def compare(self):
        unlike, compared = differences(self.killed, self.expected)
        self.unlike += unlike
        self.compared += compared
        self.ends += 1
        self.went_on += taken_over(self.killed) > 0
        shutil.rmtree(self.killed)


def kill_all(names, kills, seed, folder, share=0.6):
    """Kills runs of these scenes in turn, a share of them some time after a checkpoint; yields the name and what came of each."""
    for index, name in enumerate(names):
        victim = Victim(name, Path(folder) / str(index), random.Random(f"{seed} {name}"), share)
        for _ in range(kills // len(names) + (index < kills % len(names))):
            before = victim.kills
            while victim.kills == before:
                victim.kill_once()
        victim.end()
        yield name, victim


class Killed(RunTest):
    def test_goes_on_bit_for_bit(self):
        went_on = 0
        for name, victim in kill_all(QUICK, len(QUICK), 2, self.folder, share=1.0):
            with self.subTest(name):
                self.assertEqual(victim.unlike, [])
                self.assertEqual(victim.said, [])
                self.assertGreater(victim.compared, 40)
            went_on += victim.went_on
        self.assertGreater(went_on, len(QUICK) / 2)


class Checkpoints(RunTest):
    SCENE = ("model-a", {"Mesh/Face size": "4", "Analysis/Step": "0.2", "Drive/Stroke": "30"})

    def command(self, changes=None, output=None):
        scene, settings = self.SCENE
        return arguments(scene, {**settings, **(changes or {})}, output or self.output)

    def killed(self, changes=None, number=signal.SIGKILL, after="."):
        """A run that was killed when it had a checkpoint younger than some file."""
        command = [SPRAG, *map(str, self.command(changes)), "--quiet"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=OFTEN)

        def is_kept():
            checkpoint, file = self.output / "run.checkpoint", self.output / after
            if not (checkpoint.exists() and file.exists()):
                return None
            return after == "." or checkpoint.stat().st_mtime_ns > file.stat().st_mtime_ns or None

        self.wait_until(process, is_kept)
        process.send_signal(number)
        process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 1 if number == signal.SIGTERM else -number)

    def completed(self, *options, changes=None):
        done = self.succeeded(sprag(*self.command(changes), *options))
        self.assertEqual([name for name in os.listdir(self.output) if name.startswith("run.")], ["run.log"])
        return done

    def expect_as_uninterrupted(self, changes=None):
        whole = self.folder / "whole"
        self.assertEqual(sprag(*self.command(changes, whole), "--quiet").returncode, 0)
        self.assertEqual(differences(self.output, contents(whole))[0], [])

    def test_interrupted_goes_on(self):
        self.killed(number=signal.SIGTERM)
        with h5py.File(self.output / "result.h5", "r") as file:
            self.assertIn("interrupted", file["summary/status"].asstr()[()])
            last = len(file["table/x"]) - 1
        done = self.completed()
        self.assertRegex(done.stdout, rf"Goes on: +from t = \S+ s \(x = \S+ mm\), step {last} of an interrupted run\n")
        self.assertEqual(taken_over(self.output), last)
        self.expect_as_uninterrupted()

    def test_damaged_checkpoints_begin_anew(self):
        self.killed()
        kept = self.folder / "kept"
        shutil.copytree(self.output, kept)
        half = lambda data: data[: len(data) // 2]  # noqa: E731
        flipped = lambda data: data[: len(data) // 2] + bytes([data[len(data) // 2] ^ 4]) + data[len(data) // 2 + 1 :]  # noqa: E731
        for name, damage in (("run.checkpoint", half), ("run.checkpoint", flipped), ("run.journal", half), ("run.journal", flipped)):
            with self.subTest(name):
                shutil.rmtree(self.output)
                shutil.copytree(kept, self.output)
                (self.output / name).write_bytes(damage((kept / name).read_bytes()))
                done = self.completed("--quiet")
                self.assertRegex(done.stderr, r"checkpoint: (its rows are )?damaged: the run begins anew\n")
                self.assertEqual(taken_over(self.output), 0)
        self.expect_as_uninterrupted()

    def table(self, x):
        path = self.folder / "drive.csv"
        path.write_text("time,x\n" + "".join(f"{0.1 * i},{value}\n" for i, value in enumerate((0, 10, 20, x, 20, 10))))
        return {"Drive/Profile": "table", "Drive/Table": str(path)}

    def test_changed_drive_begins_anew(self):
        scene, settings = self.SCENE
        self.SCENE = (scene, {name: value for name, value in settings.items() if not name.startswith("Drive")})
        changes = self.table(30)
        self.killed(changes)
        self.table(31)
        done = self.completed("--quiet", changes=changes)
        self.assertIn("of input files that held something else", done.stderr)
        self.expect_as_uninterrupted(changes)

    def test_goes_on_after_a_full_disk(self):
        changes = {"Analysis/Step": "0.05", "Output/Fields": "none"}
        most = 1_400_000
        full = subprocess.run(
            [SPRAG, *map(str, self.command(changes)), "--quiet"],
            capture_output=True,
            text=True,
            check=False,
            timeout=TIMEOUT,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
            env={**ALWAYS, "OMPI_MCA_ess_singleton_isolated": "1"},
        )
        self.assertEqual(full.returncode, 1, full.stderr)
        self.assertIn("File too large", full.stderr)
        self.completed("--quiet", changes=changes)
        self.assertGreater(taken_over(self.output), 0)
        self.expect_as_uninterrupted(changes)

    def test_lost_frame_is_told(self):
        changes = {"Output/Fields": "interval", "Output/Field interval": "0.01"}
        self.killed(changes, after="fields-0000.h5")
        frame = self.output / "fields-0000.h5"
        frame.unlink()
        done = sprag(*self.command(changes), "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{frame} is gone", done.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, required=True)
    parser.add_argument("--seed", default="1")
    asked = parser.parse_args()
    print(f"{'scene':26} {'steps':>6} {'kills':>5} {'ends':>4} {'went on':>7} {'data compared':>13}  unlike")
    totals, bad = np.zeros(4, int), 0
    with tempfile.TemporaryDirectory(prefix="sprag-test-") as folder:
        for name, victim in kill_all(ALL, asked.kills, asked.seed, folder):
            numbers = (victim.kills, victim.ends, victim.went_on, victim.compared)
            said = victim.unlike + victim.said
            print(f"{name:26} {victim.steps:6d} {numbers[0]:5d} {numbers[1]:4d} {numbers[2]:7d} {numbers[3]:13d}  {said[:5] or 'none'}", flush=True)
            totals += numbers
            bad += len(said)
    print(f"{'all':26} {'':6} {totals[0]:5d} {totals[1]:4d} {totals[2]:7d} {totals[3]:13d}  {bad or 'none'}")
    return int(bad > 0)


if __name__ == "__main__":
    if any(word.startswith("--kills") for word in sys.argv[1:]):
        sys.exit(main())
    unittest.main()
