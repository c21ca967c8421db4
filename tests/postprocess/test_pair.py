# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of full mirrored pairs; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import pair  # noqa: E402
from sprag.results import read_result  # noqa: E402
from test_plot import fill_run, finish, make_run, make_transient, new_file, put  # noqa: E402


def add_second_lever(file):
    table = file["table"]
    for column, share in (("P", 0.75), ("F", 0.5)):
        if column not in table:
            put(table, column, 0.7 * table["P"][:], "N")
        put(table, f"{column}_2", share * table[column][:], "N")
    put(table, "theta", np.full(len(table["P"]), 0.06), "rad")
    put(table, "swing", 1e-3 * np.ones(len(table["P"])), "rad")
    put(table, "lateral_force", -0.25 * table["P"][:], "N")


def make_static(folder):
    file = new_file(folder)
    fill_run(file, np.concatenate((np.arange(0.0, 11), np.arange(10.0, -1, -1))))
    add_second_lever(file)
    finish(file)
    return read_result(folder)


def make_dynamic(folder):
    file = make_transient(folder)
    add_second_lever(file)
    finish(file)
    return read_result(folder)


def curve(axes, name):
    return next(line for line in axes.lines if line.get_label() == name)


class PairTest(PictureTest):
    def test_over_x_each_way(self):
        result = make_static(self.folder / "a")
        panels = pair.draw_pair(result).axes
        self.assertEqual(len(panels), 8)
        for column, rows in enumerate((slice(0, 11), slice(12, 22))):
            P, F, swing, lateral = panels[column::2]
            x = result.table["x"][rows]
            np.testing.assert_array_equal(curve(P, "first lever").get_xydata(), np.column_stack((x, result.table["P"][rows])))
            np.testing.assert_array_equal(curve(P, "second lever").get_xydata(), np.column_stack((x, result.table["P_2"][rows])))
            np.testing.assert_array_equal(curve(F, "second lever").get_ydata(), result.table["F_2"][rows])
            np.testing.assert_array_equal(swing.lines[0].get_ydata(), result.table["swing"][rows])
            np.testing.assert_array_equal(lateral.lines[0].get_ydata(), result.table["lateral_force"][rows])
        self.expect_picture(draw("plot.py", self.folder / "a"), "pair")

    def test_over_time_with_inertia_and_near_the_reversal(self):
        result = make_dynamic(self.folder / "a")
        panels = pair.draw_pair(result).axes
        self.assertEqual(len(panels), 8)
        np.testing.assert_array_equal(curve(panels[0], "second lever").get_xdata(), result.table["time"])
        near = curve(panels[1], "second lever").get_xdata()
        self.assertLess(len(near), len(result.table["time"]))
        self.assertLess(near[0], 0)
        self.assertGreater(near[-1], 0)
        self.expect_layout(panels[0].figure)

    def test_a_symmetric_pair_swings_by_round_off_alone(self):
        result = make_static(self.folder / "a")
        result.table["swing"] = 1e-16 * np.sin(result.table["x"])
        figure = pair.draw_pair(result)
        self.assertEqual([axes.get_ylabel() for axes in figure.axes[::2]], ["$P$ [N]", "$F$ [N]", "lateral force [N]"])
        self.assertIn("swing: none but round-off", [text.get_text() for text in figure.legends[0].get_texts()])
        self.expect_layout(figure)

    def test_no_second_lever_no_picture(self):
        make_run(self.folder / "a")
        self.assertFalse(pair.has_pair(read_result(self.folder / "a")))


if __name__ == "__main__":
    unittest.main()
