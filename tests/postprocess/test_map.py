# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of maps on small files of the shape sprag writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import map as stability  # noqa: E402
from sprag import results  # noqa: E402
from test_plot import put  # noqa: E402

N_FIRST, N_SECOND = 5, 4


def make_map(folder, first="Friction/Factor", second="Lever/Depth"):
    """Flutter backward where the first parameter is above 2.25 intervals; jammed beyond 3; a scene refused at the last corner."""
    folder.mkdir()
    with h5py.File(folder / "result.h5", "w") as file:
        file.attrs["format"] = "sprag result"
        file["parameters"] = "subsection Analysis\n  set Type = map\nend\n"
        group = file.create_group("map")
        i, j = np.meshgrid(np.arange(N_FIRST), np.arange(N_SECOND), indexing="ij")
        put(group, "first", 0.5 + 0.25 * np.arange(N_FIRST), "1", first)
        put(group, "second", 3.0 + 2 * np.arange(N_SECOND), "mm", second)
        put(group, "evaluated", (i % 2 == 0).astype(float), "1", "")
        put(group, "theta_0", np.where((i == 4) & (j == 3), np.nan, 0.05 + 0.01 * (i + j)), "rad", "")
        refused = (i == 4) & (j == 3)
        for way, flutter in (("forward", False), ("backward", True)):
            kind = np.where((i > 2.25) & flutter, 1.0, 0.0)
            kind = np.where((i > 3) & flutter, 3.0, kind)
            put(group, f"kind_{way}", np.where(refused, 4.0, kind), "1", "")
            put(group, f"growth_rate_{way}", np.where(refused | (kind == 3), np.nan, 40.0 * (i - 2.25)), "1/s", "")
        table = file.create_group("table")
        rows = [(2.25, j, -1, 1, 0, 1) for j in range(N_SECOND)] + [(3.5, j, -1, 1, 1, 3) for j in range(N_SECOND - 1)]
        columns = np.array(rows, dtype=float).T
        for name, values in zip(("first", "second", "direction", "along", "kind_low", "kind_high"), columns):
            scale = {"first": (0.5, 0.25), "second": (3.0, 2.0)}.get(name, (0.0, 1.0))
            put(table, name, scale[0] + scale[1] * values, "1", "")
        file.create_group("summary")
        file.create_group("meta")
    return folder


class MapTest(PictureTest):
    def test_lines_join_points_of_neighbouring_sides(self):
        result = results.read_result(make_map(self.folder / "run"))
        lines = stability.boundary_lines(result, stability.read_map(result), -1)
        self.assertEqual(set(lines), {1, 3})
        self.assertEqual((len(lines[1]), len(lines[3])), (N_SECOND - 1, N_SECOND - 2))
        for (first, second), bottom in zip(sorted(lines[1], key=lambda line: min(line[1])), (3, 5, 7)):
            np.testing.assert_allclose(first, 0.5 + 0.25 * 2.25, rtol=1e-14)
            np.testing.assert_allclose(sorted(second), (bottom, bottom + 2), rtol=1e-14)
        self.assertEqual(stability.boundary_lines(result, stability.read_map(result), 1), {})

    def test_a_corner_is_cut(self):
        # A circle about the origin: a point on the lower side of the quad (0, 0), one on its left side.
        lines = stability.segments(([0.6, 0.0], [0.0, 0.7], [1, 2], [1, 1], [0, 0]))
        self.assertEqual(lines[1], [[(0.6, 0.0), (0.0, 0.7)]])

    def test_three_kinds_meet_in_a_point(self):
        lines = stability.segments(([0.5, 0.0, 1.0], [0.0, 0.5, 0.5], [1, 2, 2], [0, 0, 1], [1, 3, 3]))
        middle = (0.5, 1 / 3)
        found = sorted(tuple(np.round(end, 12)) for end in [line[1] for kind in (1, 3) for line in lines[kind]])
        self.assertEqual(found, [tuple(np.round(middle, 12))] * 3)

    def test_pictures(self):
        geometry = ("Geometry/Interface offset", "Geometry/Pivot height")
        for number, names in enumerate((("Friction/Factor", "Lever/Depth"), geometry)):
            run = make_map(self.folder / str(number), *names)
            done = draw("plot.py", run, "--format", "png,pdf")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout.splitlines(), [str(run / "map.png"), str(run / "map.pdf")])


if __name__ == "__main__":
    unittest.main()
