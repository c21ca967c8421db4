# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of designs on small files of the shape sprag writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest  # noqa: E402
import design  # noqa: E402
import plot  # noqa: E402
from sprag import results  # noqa: E402
from test_plot import put  # noqa: E402

PARAMETERS = """subsection Analysis
  set Type = design
end

subsection Design
  set Free       = Geometry/Cylinder radius = 2 cm ... 8 cm; Rotational spring/Stiffness = 10 N m/rad ... 200 N m/rad
  set Demands    = damping slope = 0.1 +- 0.001; largest force <= 40; growth rate <= 0
  set Aim        = minimise Geometry/Cylinder radius
  set Second aim = minimise largest force
end
"""


def make_design(folder, points=6, judges=0):
    folder.mkdir()
    share = np.concatenate([[0.0], np.linspace(0, 1, points)]) if points else np.zeros(1)
    with h5py.File(folder / "result.h5", "w") as file:
        file.attrs["format"] = "sprag result"
        file["parameters"] = PARAMETERS
        table = file.create_group("table")
        put(table, "geometry_cylinder_radius", 20 + 60 * share**2, "mm")
        put(table, "rotational_spring_stiffness", 2e5 - 1e5 * share, "N mm/rad")
        put(table, "largest_force", 50 - 20 * share, "N")
        put(table, "damping_slope", 0.1 + 0 * share, "N/mm")
        put(table, "largest_violation", -1e-3 + 0 * share)
        free = file.create_group("free")
        free["parameter"] = [b"Geometry/Cylinder radius", b"Rotational spring/Stiffness"]
        put(free, "from", np.array([20.0, 1e4]))
        put(free, "to", np.array([80.0, 2e5]))
        file.create_group("summary")
        file.create_group("meta")
        if judges:
            group = file.create_group("judgements")
            put(group, "judge", np.array([b"beam", b"condensed"] * judges))
            put(group, "round", 1.0 + np.repeat(np.arange(judges), 2))
            for name, value in {"damping_slope": 0.1, "largest_force": 40.0, "growth_rate": -20.0}.items():
                put(group, name, np.full(2 * judges, 1.02 * value))
                put(group, f"expected_{name}", np.full(2 * judges, np.nan if name == "growth_rate" else value))
    return folder


class DesignTest(PictureTest):
    def draw_pictures(self, *arguments):
        result = results.read_result(make_design(self.folder / "design", *arguments))
        return plot.draw([result])

    def test_a_front_shows_aims_and_levers(self):
        pictures = self.draw_pictures()
        self.assertEqual(set(pictures), {"front"})
        aims, levers = pictures["front"].axes
        np.testing.assert_allclose(aims.lines[0].get_xdata(), np.linspace(30, 50, 6))
        np.testing.assert_allclose(aims.lines[0].get_ydata()[[0, -1]], [80, 20])
        np.testing.assert_allclose(levers.lines[0].get_ydata()[[0, -1]], [100, 0], atol=1e-9)
        self.assertIn("N", aims.get_xlabel())
        self.expect_layout(pictures["front"])

    def test_judgements_show_what_is_above_what_was_expected(self):
        for judges in (1, 4):
            with self.subTest(judges=judges):
                self.folder = self.folder / str(judges)
                self.folder.mkdir()
                pictures = self.draw_pictures(0, judges)
                self.assertEqual(set(pictures), {"judgements"})
                (axes,) = pictures["judgements"].axes
                for line in axes.lines[:2]:
                    np.testing.assert_allclose(line.get_ydata(), 2.0)
                # The growth rate is expected by nobody.
                self.assertEqual(len(axes.lines), 3)
                self.expect_layout(pictures["judgements"])

    def test_a_lever_without_front_and_judges_has_no_picture(self):
        self.assertEqual(self.draw_pictures(0, 0), {})


if __name__ == "__main__":
    unittest.main()
