# SPDX-License-Identifier: GPL-3.0-only
"""Maps from outside: the same numbers whether killed or not and for any number of processes; interrupted, refused, journals of
others. Run with /usr/bin/python3; environment: SPRAG, the program, and SPRAG_SOURCE, the sources."""

import os
import signal
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, TIMEOUT, RunTest, sets, sprag  # noqa: E402

SCENE = SOURCE / "params" / "map-friction-depth-a.prm"
# Every point of the grid: long enough, some 1700 cells, to be killed on the way.
LONG = sets(("Map/Coarsest=1", "Map/First points=41", "Map/Second points=41", "Map/Bisections=2"))
# The same grid without bisections, as long as it takes to be stopped after the first half second.
MEDIUM = sets(("Map/Coarsest=1", "Map/First points=26", "Map/Second points=26", "Map/Bisections=0"))
SHORT = sets(("Map/Coarsest=4", "Map/First points=9", "Map/Second points=9", "Map/Bisections=1"))
MESHED = (*SHORT, *sets(("Analysis/Model=condensed", "Mesh/Face size=4", "Map/Second points=5")))


def numbers(output):
    """Name -> bytes of every dataset of the map and its boundaries."""
    with h5py.File(output / "result.h5", "r") as file:
        return {f"{group}/{name}": data[()].tobytes() for group in ("map", "table") for name, data in file[group].items()}


def status(output):
    with h5py.File(output / "result.h5", "r") as file:
        return file["summary/status"].asstr()[()]


class MapTest(RunTest):
    def completed(self, name, *options):
        """Runs a map to its end: its folder and what it said on standard error."""
        output = self.folder / name
        done = sprag(SCENE, "--output", output, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(status(output), "completed")
        self.assertFalse((output / "map.journal").exists())
        return output, done.stderr

    def started(self, output, cells, *options):
        """A running map that has `cells` in its journal."""
        process = self.start(SCENE, "--output", output, *options)
        journal = output / "map.journal"
        self.wait_until(process, lambda: journal.exists() and len(journal.read_bytes().splitlines()) > cells or None)
        return process

    def kill_all(self, process, output):
        """Ends a run with all its processes at once: mpirun would leave its own a second, in which they finish a map."""
        for entry in Path("/proc").glob("[0-9]*/cmdline"):
            try:
                if str(output).encode() in entry.read_bytes():
                    os.kill(int(entry.parent.name), signal.SIGKILL)
            except OSError:
                continue  # ended meanwhile
        process.wait(TIMEOUT)

    def test_killed_and_started_again(self):
        whole, _ = self.completed("whole", *LONG)
        killed = self.folder / "killed"
        for jobs, cells in ((1, 200), (2, 700)):
            process = self.started(killed, cells, *LONG, "--jobs", jobs)
            self.kill_all(process, killed)
        with open(killed / "map.journal", "rb+") as journal:  # torn in the middle of a line
            journal.truncate(journal.seek(-30, os.SEEK_END))
        _, said = self.completed("killed", *LONG)
        self.assertRegex(said, r"map.journal: \d+ cells taken over")
        with h5py.File(killed / "result.h5", "r") as file:
            self.assertGreater(file["meta/cells_taken_over"][()], 600)
        self.assertEqual(numbers(killed), numbers(whole))

    def friction_table(self, mu):
        rows = "\n".join(f"{speed},{mu + speed / 1000}" for speed in (0, 50, 100, 200, 400))
        (self.folder / "mu.csv").write_text("speed,mu\n" + rows + "\n")

    def with_table(self):
        options = (*MEDIUM, "--set", "Friction/Law=table", "--set", f"Friction/Table={self.folder / 'mu.csv'}")
        return (*options, "--set", "Map/First parameter=Friction/Factor", "--jobs", 1)

    def test_changed_friction_table_begins_anew(self):
        self.friction_table(0.4)
        process = self.started(self.output, 100, *self.with_table())
        process.kill()
        process.wait(TIMEOUT)
        times = os.stat(self.folder / "mu.csv")
        self.friction_table(0.6)  # of the same size
        os.utime(self.folder / "mu.csv", ns=(times.st_atime_ns, times.st_mtime_ns))
        _, said = self.completed("output", *self.with_table())
        self.assertIn("another scene", said)
        fresh, _ = self.completed("fresh", *self.with_table())
        self.assertEqual(numbers(self.output), numbers(fresh))

    def test_friction_table_changed_on_the_way_ends_the_map(self):
        self.friction_table(0.4)
        process = self.started(self.output, 100, *self.with_table(), "--quiet")
        self.friction_table(0.6)
        said = process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 1)
        self.assertIn("input file has changed", said[1])
        self.friction_table(0.4)
        self.completed("output", *self.with_table())
        fresh, _ = self.completed("fresh", *self.with_table())
        self.assertEqual(numbers(self.output), numbers(fresh))

    def test_garbled_lines_are_judged_again(self):
        process = self.started(self.output, 200, *MEDIUM, "--jobs", 1)
        process.kill()
        process.wait(TIMEOUT)
        lines = (self.output / "map.journal").read_text().split("\n")
        lines[50] = "00" + lines[50]
        lines[60] = lines[60][:-3]
        (self.output / "map.journal").write_text("\n".join(lines))
        _, said = self.completed("output", *MEDIUM, "--quiet")
        self.assertRegex(said, r"map.journal: damaged lines dropped, their cells are judged again: [23]\n")
        whole, _ = self.completed("whole", *MEDIUM)
        self.assertEqual(numbers(self.output), numbers(whole))

    def test_any_number_of_processes_with_meshes(self):
        one, _ = self.completed("one", *MESHED, "--jobs", 1)
        two, _ = self.completed("two", *MESHED, "--jobs", 2)
        self.assertEqual(numbers(two), numbers(one))
        with h5py.File(one / "result.h5", "r") as file:
            self.assertTrue(np.isfinite(file["map/growth_rate_backward"][:]).all())

    def test_interrupted(self):
        for number, jobs in ((signal.SIGINT, 1), (signal.SIGTERM, 2)):
            with self.subTest(signal=number, jobs=jobs):
                output = self.folder / f"{number}-{jobs}"
                process = self.started(output, 100, *LONG, "--quiet", "--jobs", jobs)
                process.send_signal(number)
                said = process.communicate(timeout=TIMEOUT)
                self.assertEqual((process.returncode, said[0], len(said[1].splitlines())), (1, "", 1), said)
                self.assertIn("interrupted", status(output))
                with h5py.File(output / "result.h5", "r") as file:
                    judged = file["map/evaluated"][:] == 1
                    self.assertGreaterEqual(judged.sum(), 100)
                    self.assertTrue(np.isfinite(file["map/growth_rate_forward"][:][judged]).all())
                self.assertTrue((output / "map.journal").exists())

    def test_an_older_result_stays_until_the_map_is_written(self):
        output, _ = self.completed("output", *SHORT)
        before = (output / "result.h5").read_bytes()
        process = self.started(output, 100, *LONG, "--jobs", 1, "--overwrite")
        process.kill()
        process.wait(TIMEOUT)
        self.assertEqual((output / "result.h5").read_bytes(), before)

    def test_scenes_that_are_refused_are_a_kind(self):
        # Beyond R - e there is no lever that starts on the cylinder.
        options = sets(("Map/Second parameter=Geometry/Pivot height", "Map/Second from=0", "Map/Second to=16"))
        output, _ = self.completed("output", *SHORT, *options)
        with h5py.File(output / "result.h5", "r") as file:
            refused = file["map/kind_forward"][:] == 4
            height = file["map/second"][:]
            np.testing.assert_array_equal(refused, np.broadcast_to(height >= 56 - 45.6, refused.shape))
            self.assertTrue(np.isnan(file["map/theta_0"][:][refused]).all())
            along = file["table/along"][:] == 2
            found = file["table/second"][:][along & (np.maximum(file["table/kind_low"][:], file["table/kind_high"][:]) == 4)]
            self.assertGreater(len(found), 0)
            self.assertLessEqual(np.abs(found - (56 - 45.6)).max(), 16 / 8 / 2 / 2)


if __name__ == "__main__":
    unittest.main()
