# SPDX-License-Identifier: GPL-3.0-only
"""Shares helpers between tests of the program from outside. Environment: SPRAG, the program, and SPRAG_SOURCE, the sources."""

import os
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
from folders import FolderTest

SOURCE = Path(os.environ.get("SPRAG_SOURCE", Path(__file__).resolve().parents[2]))
SPRAG = os.environ.get("SPRAG", str(SOURCE / "build" / "sprag"))
TIMEOUT = 300  # seconds: a run that hangs is a failed test


def sprag(*arguments, program=SPRAG, timeout=TIMEOUT, **options):
    command = [str(program), *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=timeout, stdin=subprocess.DEVNULL, **options
    )


def sets(changes):
    """The words of --set for {name: value} or texts of the form name=value."""
    texts = [f"{name}={value}" for name, value in changes.items()] if isinstance(changes, dict) else changes
    return [word for text in texts for word in ("--set", text)]


def run_scene(scene, changes, *options, **settings):
    """Runs a scene of params/ with these changes."""
    return sprag(SOURCE / "params" / f"{scene}.prm", *sets(changes), *options, **settings)


def counted(names):
    """Warnings as the last line that is printed tells them."""
    if not names:
        return "no warnings"
    return f"{len(names)} warning{'s' if len(names) > 1 else ''}: {', '.join(names)}"


class RunTest(FolderTest):
    """Has a folder for what a run writes, which is not there yet."""

    def setUp(self):
        super().setUp()
        self.output = self.folder / "output"

    def completed(self, scene, changes, *options):
        """Runs a scene of params/ to its end without a message and returns its output."""
        done = run_scene(scene, changes, *options, "--output", self.output, "--overwrite")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def expect_refused(self, done, *texts):
        """One message with these texts."""
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for text in texts:
            self.assertIn(text, done.stderr)

    def read(self, group, *names):
        """Numbers and texts of a group of the result, all or these."""
        with h5py.File(self.output / "result.h5", "r") as file:
            data = {name: file[group][name] for name in names or file[group]}
            return {name: each.asstr()[()] if each.dtype.kind == "O" else each[()] for name, each in data.items()}

    def start(self, *arguments):
        process = subprocess.Popen([SPRAG, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def wait_until(self, process, condition):
        """While the process goes on: what `condition` gives once that is not None."""
        end = time.monotonic() + TIMEOUT
        while time.monotonic() < end:
            self.assertIsNone(process.poll(), "the run ended too early to be watched")
            if (found := condition()) is not None:
                return found
            time.sleep(0.01)
        return self.fail(f"still waiting after {TIMEOUT} s")

    def rows(self):
        """x of the rows that the result file has so far, which are whole."""
        try:
            with h5py.File(self.output / "result.h5", "r", swmr=True) as file:
                columns = [file["table"][name][:] for name in ("time", "x", "Q")]
        except (OSError, KeyError):
            return []
        length = min(map(len, columns))
        for values in columns:
            self.assertTrue(np.isfinite(values[:length]).all())
        return columns[1][:length]

    def wait_for_rows(self, process, number):
        return self.wait_until(process, lambda: rows if len(rows := self.rows()) >= number else None)
