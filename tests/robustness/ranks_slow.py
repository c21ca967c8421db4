# SPDX-License-Identifier: GPL-3.0-only
"""Several processes of MPI that write fields of modes, and one of which is killed."""

import os
import shutil
import signal
import subprocess
from pathlib import Path

from ranks import ALONE, SETTINGS, SOURCE, SPRAG, TIMEOUT, RanksTest, command, finished, read_fields, run

OFTEN = {**ALONE, "SPRAG_CHECKPOINT_SECONDS": "0.02"}


def find_ranks(mpirun):
    """Identifiers of the processes of one that has begun."""
    words = [path.read_text().split() for path in Path(f"/proc/{mpirun.pid}/task").glob("*/children")]
    return sorted(int(word) for word in sum(words, []))


def mpirun_alone(words, scene):
    return ["mpirun", "-n", "1", words[0], scene, *words[2:]]


class SlowRanks(RanksTest):
    def test_one_that_fails_alone_ends_all(self):
        done = self.ranks_apart(("here", "output"), ("there", "output"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("output/study.journal cannot be written"), 1, done.stderr)
        words = command(self.output, SETTINGS)
        for own, other in ((0, 1), (1, 0)):
            scenes = [words[1], str(self.folder / "missing.prm")]
            done = finished([*mpirun_alone(words, scenes[own]), ":", *mpirun_alone(words, scenes[other])[1:]])
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count("missing.prm: cannot be read"), 1, done.stderr)

    def test_do_not_change_slides(self):
        changes = {"Stability/Critical": "none", "Stability/Roles": "off"}
        self.expect_same_data("stability", changes, "modes", ("frequency", "growth_rate"), 1e-8)
        self.expect_same_data("modal", {}, "modes", ("frequency", "across_real", "sideways_real"), 1e-8)

    def test_without_the_folder_end_with_a_message(self):
        """Runs in two folders, as on machines that do not share their disks."""
        places = [self.folder / str(rank) for rank in range(2)]
        words = ["mpirun"]
        for place in places:
            place.mkdir()
            words += [":"] * (place != places[0]) + ["-n", "1", "-wdir", str(place), *command("output", SETTINGS)]
        done = finished(words)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("process 1 of mpirun: cannot write output/fields-mesh.h5: No such file"), 1, done.stderr)
        self.assertEqual(list(places[1].iterdir()), [])

    def test_of_another_program_are_refused(self):
        program = Path(SPRAG).resolve().with_name("sprag-models")
        other = self.folder / "sprag-models"
        shutil.copy(program, other)
        with open(other, "ab") as file:
            file.write(b"another version")
        scene = SOURCE / "params" / "model-a.prm"
        sets = [part for name, value in SETTINGS.items() for part in ("--set", f"{name}={value}")]
        each = [scene, "--output", self.output, *sets]
        done = finished(list(map(str, ["mpirun", "-n", "1", program, *each, ":", "-n", "1", other, *each])))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("process 1 of mpirun runs another program"), 1, done.stderr)
        self.assertFalse(self.output.exists())

    def test_go_on_after_one_was_killed(self):
        whole = self.folder / "whole"
        self.assertEqual(run(2, whole, SETTINGS).returncode, 0)
        words = ["mpirun", "-n", "2", *command(self.output, SETTINGS)]
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=OFTEN)
        self.addCleanup(process.communicate)
        checkpoint, frame = self.output / "run.checkpoint", self.output / "fields-0001.h5"
        is_behind = lambda: checkpoint.exists() and frame.exists() and checkpoint.stat().st_mtime_ns > frame.stat().st_mtime_ns  # noqa: E731
        self.wait_until(process, lambda: is_behind() or None)
        os.kill(find_ranks(process)[1], signal.SIGKILL)
        process.communicate(timeout=TIMEOUT)
        self.assertNotEqual(process.returncode, 0)
        done = self.succeeded(run(2, self.output, SETTINGS))
        self.assertRegex(done.stdout, "Goes on: .* of an interrupted run")
        self.expect_alike(read_fields(self.output), read_fields(whole))
