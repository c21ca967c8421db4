# SPDX-License-Identifier: GPL-3.0-only
"""Several processes of MPI that write fields of modes, and one of which is killed."""

import os
import signal
import subprocess
import unittest
from pathlib import Path

import numpy as np
from ranks import ALONE, HELD, SETTINGS, TIMEOUT, RanksTest, command, fields_of, run

OFTEN = {**ALONE, "SPRAG_CHECKPOINT_SECONDS": "0.02"}


def ranks_of(mpirun):
    """Identifiers of the processes of one that has begun."""
    words = [path.read_text().split() for path in Path(f"/proc/{mpirun.pid}/task").glob("*/children")]
    return sorted(int(word) for word in sum(words, []))


class SlowRanks(RanksTest):
    def test_do_not_change_fields_of_modes(self):
        changes = {**HELD, "Analysis/Type": "modal", "Stability/Modes": "2", "Output/Fields": "turning points"}
        alone, shared = ({}, {})
        for ranks, fields in ((1, alone), (2, shared)):
            folder = self.folder / str(ranks)
            done = run(ranks, folder, changes)
            self.assertEqual(done.returncode, 0, done.stderr)
            fields.update(fields_of(folder))
        self.assertGreater(np.abs(alone["mode-02.h5 frame-0023/mode-02/displacement"]).max(), 1)
        self.expect_alike(shared, alone)

    def test_go_on_after_one_was_killed(self):
        whole = self.folder / "whole"
        self.assertEqual(run(2, whole, SETTINGS).returncode, 0)
        words = ["mpirun", "-n", "2", *command(self.output, SETTINGS)]
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=OFTEN)
        self.addCleanup(process.communicate)
        checkpoint, frame = self.output / "run.checkpoint", self.output / "fields-0001.h5"
        is_behind = lambda: checkpoint.exists() and frame.exists() and checkpoint.stat().st_mtime_ns > frame.stat().st_mtime_ns  # noqa: E731
        self.wait_until(process, lambda: is_behind() or None)
        os.kill(ranks_of(process)[1], signal.SIGKILL)
        process.communicate(timeout=TIMEOUT)
        self.assertNotEqual(process.returncode, 0)
        done = run(2, self.output, SETTINGS)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "Goes on: .* of an interrupted run")
        self.expect_alike(fields_of(self.output), fields_of(whole))


if __name__ == "__main__":
    unittest.main()
