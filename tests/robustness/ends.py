# SPDX-License-Identifier: GPL-3.0-only
"""Tests the ends of runs: asked for, crashed, short of memory or disk, robbed of their folder, beside another run."""

import os
import resource
import shutil
import signal
import tempfile
import time
from pathlib import Path

import h5py

from runs import SOURCE, TIMEOUT, RunTest, sets, sprag

MODEL_A = SOURCE / "params" / "model-a.prm"

CLOSED_FORM = ("--set", "Analysis/Model=closed form")
COARSE = sets(("Mesh/Face size=4", "Analysis/Step=5"))
LONG = sets(("Mesh/Face size=4", "Analysis/Step=0.005", "Output/Fields=none"))
# The compliance of the friction face takes some seconds in one piece.
FINE = ("--set", "Mesh/Face size=0.03", "--set", "Output/Fields=none")


def mesh_files():
    return set(Path(tempfile.gettempdir()).glob("sprag-*.msh"))


class EndsTest(RunTest):
    def command(self, *options):
        return MODEL_A, "--output", self.output, "--quiet", *options

    def run_to_end(self, *options, **settings):
        return sprag(*self.command(*options), **settings)

    def start_with_rows(self, number, *options):
        process = self.start(*self.command(*LONG, *options))
        self.wait_for_rows(process, number)
        return process

    def failed(self, process, text):
        """Exit 1 with one message that holds the text; a finished file: its status and number of rows."""
        said = process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 1, said)
        self.assertEqual((said[0], len(said[1].splitlines())), ("", 1), said)
        self.assertIn(text, said[1])
        with h5py.File(self.output / "result.h5", "r") as file:
            self.assertIn("subsection Drive", file["parameters"].asstr()[()])
            return file["summary/status"].asstr()[()], len(file["table/x"]) if "x" in file["table"] else 0

    def working_process(self, process):
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        return int(children[0]) if children else None

    def start_working(self, seconds, *options):
        """A run whose working process has had so much CPU time."""
        process = self.start(*self.command(*options))

        def has_worked():
            if worker := self.working_process(process):
                used = Path(f"/proc/{worker}/stat").read_text().rpartition(")")[2].split()[11:13]
                if sum(map(int, used)) > seconds * os.sysconf("SC_CLK_TCK"):
                    return process
            return None

        return self.wait_until(process, has_worked)


class Interrupted(EndsTest):
    def test_steps_are_kept(self):
        """Signals to the program, and crashes of its working process."""
        crashes = {signal.SIGSEGV: "Segmentation fault", signal.SIGKILL: "want of memory"}
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, *crashes):
            with self.subTest(signal=number):
                process = self.start_with_rows(5)
                os.kill(self.working_process(process) if number in crashes else process.pid, number)
                text = crashes.get(number, "interrupted")
                status, rows = self.failed(process, text)
                self.assertIn(text, status)
                self.assertGreaterEqual(rows, 5)
                shutil.rmtree(self.output)

    def test_inside_a_library(self):
        before = mesh_files()
        process = self.start_working(1.0, *FINE)
        begin = time.monotonic()
        process.send_signal(signal.SIGTERM)
        status, rows = self.failed(process, "interrupted")
        self.assertLess(time.monotonic() - begin, 10)
        self.assertIn("interrupted", status)
        self.assertEqual(rows, 0)
        self.assertEqual(mesh_files() - before, set())
        self.assertEqual([path.name for path in self.output.iterdir()], ["result.h5"])

    def test_while_meshing(self):
        (self.folder / "endless.geo").write_text("For i In {1:1e9}\n  Point(i) = {0, 0, 0};\nEndFor\n")
        process = self.start_working(0.05, "--set", f"Mesh/File={self.folder}/endless.geo")
        process.send_signal(signal.SIGINT)
        self.assertIn("interrupted", self.failed(process, "interrupted")[0])

    def test_twice_ends_at_once(self):
        process = self.start_working(1.0, *FINE)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        self.failed(process, "interrupted")
        self.assertLess(time.monotonic() - begin, 1.9)


class Crashed(EndsTest):
    def test_folder_removed(self):
        process = self.start_with_rows(5)
        shutil.rmtree(self.output)
        said = process.communicate(timeout=TIMEOUT)[1]
        self.assertEqual((process.returncode, len(said.splitlines())), (1, 1), said)
        self.assertIn(f"{self.output}/result.h5 was removed", said)

    def test_disk_full(self):
        fields = ("--set", "Mesh/Face size=0.15", "--set", "Analysis/Step=5", "--set", "Output/Fields=interval")
        for limit, options, name in ((1_400_000, LONG, "result.h5"), (2_500_000, fields, "fields")):
            with self.subTest(limit=limit):
                # The limit is not for files of Open MPI's daemon.
                done = self.run_to_end(
                    *options,
                    preexec_fn=lambda most=limit: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
                    env={**os.environ, "OMPI_MCA_ess_singleton_isolated": "1"},
                )
                self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
                self.assertIn(f"cannot write {self.output}/{name}", done.stderr)
                self.assertIn("File too large", done.stderr)
                self.assertIn("File too large", self.read("summary", "status")["status"])
                self.assertTrue(name == "fields" or len(self.read("table", "x")["x"]) > 0)
                for path in self.output.glob("*.h5"):
                    h5py.File(path, "r").close()
                shutil.rmtree(self.output)


class Unmet(EndsTest):
    def test_what_stops_a_design_is_told_whole(self):
        design = {"Free": "Rotational spring/Stiffness = 10 N m/rad ... 200 N m/rad; Geometry/Cylinder radius = 50 ... 60; Geometry/Pivot distance = 150 ... 190; Geometry/Pivot height = 0 ... 5", "Demands": "damping slope >= 0.3; largest force <= 5 N; slope ratio = 1 +- 0.1; jamming margin >= 0.6"}
        done = self.run_to_end("--set", "Analysis/Type=design", *sets({f"Design/{name}": text for name, text in design.items()}))
        self.assertEqual(done.returncode, 1, done.stderr)
        status = self.read("summary", "status")["status"]
        self.assertGreater(len(status), 400)
        self.assertEqual(done.stderr, f"sprag: {status}\n")
        self.assertIn(status, (self.output / "run.log").read_text(encoding="utf-8"))


class Refused(EndsTest):
    def test_too_fine_a_mesh(self):
        for options in ((), ("--set", "Analysis/Type=transient", "--set", "Analysis/Model=condensed")):
            with self.subTest(options=options):
                done = self.run_to_end("--set", "Mesh/Face size=0.0005", *options)
                self.expect_refused(done, "Mesh/Face size = 0.0005", "GB of memory", "free on this machine")
                self.assertFalse(self.output.exists())

    def test_too_small_a_stack(self):
        soft, hard = 1 << 16, resource.getrlimit(resource.RLIMIT_STACK)[1]
        for most, code in ((soft, 2), (hard, 0)):
            done = self.run_to_end(*COARSE, preexec_fn=lambda most=most: resource.setrlimit(resource.RLIMIT_STACK, (soft, most)))
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (code, code // 2), done.stderr)
            self.assertEqual("64 kB by ulimit -s: must be at least 1024 kB" in done.stderr, code == 2)

    def test_slow_and_held(self):
        held = ("Analysis/Type=stability", "Analysis/Model=beam", "Stability/Critical=none", "Drive/Speed=1e-8")
        self.completed("model-a", held)
        self.assertIn(self.read("summary")["verdict"], ("stable", "flutter"))

    def test_second_run_in_the_folder(self):
        first = self.start_with_rows(1)
        self.expect_refused(self.run_to_end(*COARSE), str(self.output), "another run writes there", f"process {self.working_process(first)}")
        first.kill()
        first.wait(TIMEOUT)
        self.expect_refused(self.run_to_end(*COARSE), "unfinished result of a run with other parameters")
        self.assertEqual(self.run_to_end(*COARSE, "--overwrite").returncode, 0)

    def test_another_result(self):
        self.assertEqual(self.run_to_end(*CLOSED_FORM).returncode, 0)
        before = (self.output / "result.h5").read_bytes()
        other = (*CLOSED_FORM, "--set", "Drive/Stroke=10")
        self.expect_refused(self.run_to_end(*other), str(self.output), "result.h5", "--overwrite")
        self.assertEqual((self.output / "result.h5").read_bytes(), before)
        self.assertEqual(self.run_to_end(*CLOSED_FORM).returncode, 0)
        self.assertEqual(self.run_to_end(*other, "--overwrite").returncode, 0)
        self.assertEqual(self.read("table", "x")["x"].max(), 10)

    def test_result_that_is_no_file(self):
        self.output.mkdir()
        os.mkfifo(self.output / "result.h5")
        self.expect_refused(self.run_to_end(*CLOSED_FORM), "result.h5 is no regular file")

    def test_damaged_earlier_result(self):
        self.assertEqual(self.run_to_end(*CLOSED_FORM).returncode, 0)
        path = self.output / "result.h5"
        whole = path.read_bytes()
        for size in (100, len(whole) // 2):
            path.write_bytes(whole[:size])
            self.expect_refused(self.run_to_end(*CLOSED_FORM), "result.h5", "damaged", "--overwrite")
            self.assertEqual(path.read_bytes(), whole[:size])
        self.assertEqual(self.run_to_end(*CLOSED_FORM, "--overwrite").returncode, 0)
        for zeros in (0, 1000):  # of a run that was killed before it wrote
            path.write_bytes(bytes(zeros))
            self.assertEqual(self.run_to_end(*CLOSED_FORM).returncode, 0)

    def test_two_at_once_in_a_new_folder(self):
        for _ in range(4):
            runs = [self.start(*self.command(*CLOSED_FORM, "--set", f"Drive/Stroke={stroke}")) for stroke in (10, 20)]
            ends = [(run.wait(TIMEOUT), stroke) for run, stroke in zip(runs, (10, 20))]
            self.assertEqual(sorted(code for code, _ in ends), [0, 2])
            self.assertEqual(self.read("table", "x")["x"].max(), dict(ends)[0])
            shutil.rmtree(self.output)
