# SPDX-License-Identifier: GPL-3.0-only
"""Studies from outside: rows as the runs by themselves, failing runs, killed and started again, any number of processes, refusals."""

import os
import shutil
import signal
import unittest
from pathlib import Path

import h5py
import numpy as np

from runs import SOURCE, SPRAG, TIMEOUT, RunTest, sets, sprag
from system_calls import CAN_FILTER, without_locks

STATIC = SOURCE / "params" / "model-a.prm"
IN_TIME = SOURCE / "params" / "reversal-a.prm"
COARSE = {"Mesh/Face size": "4", "Analysis/Step": "5"}
# 32 slides of a beam: long enough to be killed on the way.
MANY = {
    "Study/Type": "stability",
    "Study/Vary": "Friction/Factor = 0.5 ... 1.5 : 4; Lever/Depth = 5 ... 20 : 8",
    "Stability/Critical": "none",
    "Stability/Roles": "off",
}
COSTS = {"cpu_time", "cpu_time_spent", "wall_time", "peak_memory"}


def settings(changes):
    return sets({"Analysis/Type": "study", **changes})


def read(output):
    """Numbers and texts of the runs, entries of the summary."""
    with h5py.File(output / "result.h5", "r") as file:
        return (
            {name: data[:] for name, data in file["table"].items()},
            {name: data.asstr()[:] for name, data in file["runs"].items()},
            {name: data.asstr()[()] if data.dtype == object else data[()] for name, data in file["summary"].items()},
        )


class StudyTest(RunTest):
    def study(self, scene, changes, *options, output=None):
        output = output or self.output
        done = self.succeeded(sprag(scene, "--output", output, *settings(changes), *options))
        self.assertEqual(sorted(path.name for path in output.iterdir()), ["result.h5", "run.log"])
        return (*read(output), done)

    def expect_same_numbers(self, one, other):
        self.assertEqual(set(one), set(other))
        for name in set(one) - COSTS:
            np.testing.assert_array_equal(one[name], other[name], err_msg=name)

    def test_rows_are_the_runs_by_themselves(self):
        vary = "Mesh/Degree = 1, 2; Friction/Law = Coulomb, cork on aluminium"
        table, texts, summary, _ = self.study(STATIC, {**COARSE, "Study/Vary": vary})
        self.assertEqual(list(texts["friction_law"]), 2 * ["Coulomb", "cork on aluminium"])
        self.assertEqual(list(table["mesh_degree"]), [1, 1, 2, 2])
        self.assertEqual((summary["runs"], summary["completed"]), (4, 4))
        for row in (1, 2):  # each value once
            output = self.folder / str(row)
            own = {**COARSE, "Mesh/Degree": texts["mesh_degree"][row], "Friction/Law": texts["friction_law"][row]}
            self.assertEqual(sprag(STATIC, "--output", output, *sets(own), "--quiet").returncode, 0)
            with h5py.File(output / "result.h5", "r") as file:
                for name in ("peak_P_backward", "loop_area", "largest_pressure", "largest_layer_stress", "steps"):
                    self.assertEqual(table[name][row], file["summary"][name][()], name)
                    self.assertEqual(file["summary"][name].attrs["unit"], self.unit(name))

    def unit(self, name):
        with h5py.File(self.output / "result.h5", "r") as file:
            return file["table"][name].attrs["unit"]

    def test_errors_against_a_reference_are_those_of_the_numbers(self):
        changes = {"Study/Vary": "Mesh/Face size = 8, 4, 2", "Study/Reference": "Mesh/Face size = 1", "Analysis/Step": "5"}
        table, _, summary, done = self.study(STATIC, changes)
        self.assertEqual(summary["reference"], "completed")
        with h5py.File(self.output / "result.h5", "r") as file:
            for name in ("loop_area", "largest_pressure"):
                expected = np.abs(table[name] / file["reference"][name][0] - 1)
                np.testing.assert_allclose(table[f"error_{name}"], expected, rtol=1e-9)
            chosen = file["trade/run_loop_area"][:]
        worst = np.max([table[f"error_{name}"] for name in ("P", "Q", "loop_area", "largest_pressure")], axis=0)
        np.testing.assert_array_equal(table["error_all"], worst)
        self.assertTrue((table["error_P"] > 0).all())
        cheap = np.argsort(table["work"])
        lasting = np.maximum.accumulate(table["error_loop_area"][::-1])[::-1]  # of those with smaller faces as well
        exact = [next((run for run in cheap if lasting[run] <= limit), np.nan) for limit in (0.1, 1e-2, 1e-3, 1e-4)]
        np.testing.assert_array_equal(chosen, exact)
        self.assertRegex(done.stdout, r"observed order +over Mesh/Face size: .*\blargest_pressure -?\d")

    def test_runs_that_fail_or_are_refused_are_rows(self):
        vary = "Analysis/Maximum deviation = 0, 1e-9, 0, 0; Mesh/Face size = 4, 4, 300, 4; Analysis/Warnings = report, report, report, error"
        table, texts, summary, done = self.study(STATIC, {**COARSE, "Study/Combine": "list", "Study/Vary": vary})
        self.assertEqual(list(texts["outcome"]), ["completed", "failed", "refused", "failed"])
        self.assertEqual((summary["completed"], summary["failed"], summary["refused"]), (1, 2, 1))
        self.assertIn("is larger than Analysis/Maximum deviation = 1e-09", texts["reason"][1])
        self.assertIn("must be less than the lever's length", texts["reason"][2])
        self.assertIn("coarse_contact", texts["warnings"][0])
        np.testing.assert_array_equal(np.isfinite(table["loop_area"]), [True, False, False, False])
        self.assertIn("refused: Analysis/Maximum deviation = 0, Mesh/Face size = 300", done.stdout)
        # All but the refused one warn, and the study of them.
        self.assertEqual(done.stdout.splitlines()[-1], "completed, 1 warning: runs_with_warnings")
        self.assertRegex(self.read("warnings")["runs_with_warnings"], r"^3 of 4 runs have warnings: .*coarse_contact in 3\b")

    def test_warnings_of_runs_fail_a_study_that_is_told_so(self):
        vary = {**COARSE, "Study/Vary": "Friction/Factor = 0.8, 1", "Analysis/Warnings": "error"}
        done = sprag(STATIC, "--output", self.output, *settings(vary))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.splitlines()[-1], "^sprag: Analysis/Warnings = error: 1 warning: runs_with_warnings. The first says: 2 of 2 runs")

    def test_a_row_tells_a_missed_target_and_what_was_chosen(self):
        vary = {"Accuracy/Quantity": "Q", "Study/Vary": "Accuracy/Target = 3e-4, 0"}
        _, texts, _, _ = self.study(STATIC, {**vary, "Mesh/Face size": "4"})
        self.assertEqual([("target_missed" in each) for each in texts["warnings"]], [True, False])
        self.assertRegex(texts["chosen_settings"][0], "Analysis/Step = ")
        self.assertEqual(texts["chosen_settings"][1], "")

    def test_a_step_that_is_given_is_fixed(self):
        short = {"Drive/Start": "45", "Drive/Stroke": "45.6", "Drive/Reversal duration": "2e-3"}
        table, *_ = self.study(IN_TIME, {**short, "Study/Type": "transient", "Study/Vary": "Time/Step = 2e-5, 1e-5"})
        self.assertAlmostEqual(table["steps"][1] / table["steps"][0], 2, delta=0.02)

    def expect_same_after_a_kill(self, scene, changes, most_lines):
        whole, *_ = self.study(scene, changes, "--jobs", 1, output=self.folder / "whole")
        journal = self.output / "study.journal"
        process = self.start(scene, "--output", self.output, *settings(changes), "--jobs", 1)
        self.wait_until(process, lambda: journal.exists() and len(journal.read_bytes().splitlines()) > most_lines or None)
        process.kill()
        process.wait(TIMEOUT)
        with open(journal, "rb+") as file:  # torn in the middle of a line
            file.truncate(file.seek(0, 2) - 30)
        table, _, _, done = self.study(scene, changes)
        self.assertRegex(done.stderr, r"study.journal: \d+ runs? taken over")
        taken_over = self.read("meta", "runs_taken_over")["runs_taken_over"]
        self.assertTrue(0.6 * most_lines - 1 < taken_over < len(table["run"]), taken_over)
        self.expect_same_numbers(whole, table)

    def test_killed_and_started_again(self):
        self.expect_same_after_a_kill(IN_TIME, MANY, 10)

    def test_meshes_do_not_depend_on_a_kill(self):
        """Faces in contact follow friction: a mesh is shared by runs that read the same, not by those that come behind each other."""
        vary = "Lever/Depth = 15, 20; Friction/Factor = 0.1, 3, 1"
        self.expect_same_after_a_kill(STATIC, {"Mesh/Face size": "2", "Analysis/Step": "4", "Study/Vary": vary}, 3)

    def other_build(self):
        """The program with a byte behind its end."""
        (self.folder / "other").mkdir()
        for name in ("sprag", "sprag-models"):
            copy = Path(shutil.copy(Path(SPRAG).resolve().with_name(name), self.folder / "other"))
            copy.write_bytes(copy.read_bytes() + b"another")
        return self.folder / "other" / "sprag"

    def test_another_build_begins_anew(self):
        other = self.other_build()
        process = self.start(IN_TIME, "--output", self.output, *settings(MANY), "--jobs", 1)
        journal = self.output / "study.journal"
        self.wait_until(process, lambda: journal.exists() and len(journal.read_bytes().splitlines()) > 5 or None)
        process.kill()
        process.wait(TIMEOUT)
        done = self.succeeded(sprag(IN_TIME, "--output", self.output, *settings(MANY), "--jobs", 1, program=other))
        self.assertIn("study.journal is of another scene or build: begun anew", done.stderr)

    def test_bases_are_of_a_build_and_bounded(self):
        cache = self.folder / "cache"
        cache.mkdir()
        oldest = cache / f"basis-{0:016x}.bin"
        oldest.write_text("sprag basis ")
        os.truncate(oldest, 2 << 30)
        os.utime(oldest, (1, 1))
        changes = {**COARSE, "Analysis/Type": "modal", "Analysis/Model": "condensed", "Condensed/Modes": "4", "Condensed/Cache": str(cache)}
        for number, program in enumerate((SPRAG, SPRAG, self.other_build()), 1):
            self.succeeded(sprag(STATIC, "--output", self.folder / str(number), *settings(changes), program=program))
            self.assertFalse(oldest.exists())
            self.assertEqual(len(list(cache.iterdir())), 1 + (number == 3))

    @unittest.skipUnless(CAN_FILTER, "knows the system calls of x86_64")
    def test_a_disk_without_locks(self):
        few = {**MANY, "Study/Vary": "Friction/Factor = 0.9, 1"}
        self.succeeded(sprag(IN_TIME, "--output", self.output, *settings(few), "--jobs", 1, preexec_fn=without_locks()))

    def test_no_more_processes_than_runs(self):
        few = {**MANY, "Study/Vary": "Friction/Factor = 0.9, 1"}
        nowhere = {**os.environ, "TMPDIR": "/proc"}  # which mpirun cannot use
        self.succeeded(sprag(IN_TIME, "--output", self.output, *settings(few), "--jobs", 64, env=nowhere))
        self.assertEqual(self.read("meta", "ranks")["ranks"], 2)

    def test_interrupted(self):
        more = {**MANY, "Study/Vary": "Lever/Depth = 5 ... 20 : 400"}  # than two processes end before the signal reaches them
        process = self.start(IN_TIME, "--output", self.output, *settings(more), "--jobs", 2, "--quiet")
        journal = self.output / "study.journal"
        self.wait_until(process, lambda: journal.exists() and len(journal.read_bytes().splitlines()) > 8 or None)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=TIMEOUT)
        self.assertEqual((process.returncode, said[0]), (1, ""))
        self.assertEqual(len(said[1].splitlines()), 1, said[1])
        table, _, summary = read(self.output)
        self.assertIn("interrupted", summary["status"])
        self.assertGreaterEqual(len(table["run"]), 8)
        self.assertTrue(journal.exists())

    def test_any_number_of_processes(self):
        changes = {**COARSE, "Study/Vary": "Mesh/Face size = 4, 3; Friction/Factor = 0.8, 1, 1.2"}
        one, *_ = self.study(STATIC, changes, "--jobs", 1, output=self.folder / "one")
        several, *_ = self.study(STATIC, changes, "--jobs", 3, output=self.folder / "several")
        self.expect_same_numbers(one, several)
        with h5py.File(self.folder / "several" / "result.h5", "r") as file:
            self.assertEqual(file["meta/ranks"][()], 3 if shutil.which("mpirun") else 1)

    def test_a_mesh_is_made_once(self):
        table, *_ = self.study(STATIC, {**COARSE, "Study/Vary": "Friction/Factor = 0.8, 1, 1.2"}, "--jobs", 1)
        saved = table["cpu_time"] - table["cpu_time_spent"]
        self.assertEqual(saved[0], 0)
        self.assertTrue((saved[1:] > 0).all())

    def test_bad_input_is_told_once(self):
        wrong = (
            ({"Study/Vary": "Mesh/Fce size = 1"}, "did you mean 'Mesh/Face size'?"),
            ({"Study/Vary": "Mesh/Face size = 300, 400"}, "every run is refused"),
            ({"Study/Vary": "Friction/Coefficient = 0.5"}, "counts only with Friction/Law = Coulomb"),
            ({"Study/Reference": "Mesh/Face size = 300"}, "Study/Reference is refused"),
        )
        for changes, message in wrong:
            for command in ((), ("--validate",)):
                done = sprag(STATIC, "--output", self.output, *settings(changes), *command)
                self.expect_refused(done, *changes, message)
                self.assertFalse(self.output.exists())
