# SPDX-License-Identifier: GPL-3.0-only
"""Maps from outside: tables that change before or on the way, scenes that are refused."""

import os

import h5py
import numpy as np

from runs import SOURCE, TIMEOUT, RunTest, sets, sprag

SCENE = SOURCE / "params" / "map-friction-depth-a.prm"
# Every point of a grid: as long as it takes to be stopped after the first half second.
MEDIUM = sets(("Map/Coarsest=1", "Map/First points=26", "Map/Second points=26", "Map/Bisections=0"))
SHORT = sets(("Map/Coarsest=4", "Map/First points=9", "Map/Second points=9", "Map/Bisections=1"))


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
        done = self.succeeded(sprag(SCENE, "--output", output, *options))
        self.assertEqual(status(output), "completed")
        self.assertFalse((output / "map.journal").exists())
        return output, done.stderr

    def started(self, output, cells, *options):
        """A running map that has `cells` in its journal."""
        process = self.start(SCENE, "--output", output, *options)
        journal = output / "map.journal"
        self.wait_until(process, lambda: journal.exists() and len(journal.read_bytes().splitlines()) > cells or None)
        return process

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
