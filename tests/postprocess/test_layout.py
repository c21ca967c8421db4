# SPDX-License-Identifier: GPL-3.0-only
"""Tests that each kind of bad layout is found, and none in a good picture; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw, problems  # noqa: E402
from style import plt, use_print_style  # noqa: E402


class LayoutTest(PictureTest):
    def setUp(self):
        super().setUp()
        use_print_style()
        self.addCleanup(plt.close, "all")
        self.figure, self.panels = plt.subplots(1, 2, figsize=(6, 3))
        for axes in self.panels:
            axes.plot(np.arange(10.0), np.arange(10.0) ** 2, label="square")

    def expect(self, *words):
        """One thing is wrong, and is told with these words."""
        found = problems(self.figure)
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])

    def test_a_good_figure(self):
        for axes in self.panels:
            axes.set(xlabel="x", ylabel="y")
            axes.legend(loc="upper left")
        self.expect_layout(self.figure)

    def test_an_empty_panel(self):
        self.panels[1].lines[0].remove()
        self.panels[1].set(xlim=(1, 2), ylabel="forgotten")
        self.expect("panel 2", "forgotten", "no data")

    def test_a_line_across_the_panel_is_no_data(self):
        self.panels[1].lines[0].remove()
        self.panels[1].axhline(0.5)
        self.panels[1].set_xlim(1, 2)
        self.expect("no data")

    def test_data_out_of_sight(self):
        self.panels[0].set_xlim(20, 30)
        self.expect("panel 1", "no data")

    def test_a_panel_that_says_why_it_is_empty(self):
        self.panels[1].lines[0].remove()
        self.panels[1].set_xlim(1, 2)
        self.panels[1].annotate("nothing was written", (1.5, 0.5), ha="center")
        self.expect_layout(self.figure)

    def test_texts_over_one_another(self):
        self.panels[0].set_title("a title that is long, yes, long", loc="left")
        self.panels[0].set_title("and another such title, no less", loc="right")
        self.expect("'a title that is long, yes, long' lies over 'and another such title, no less'")

    def test_tick_labels_over_one_another(self):
        self.panels[0].set_xticks((4, 5), ("many words here", "and here"))
        self.expect("'many words here' lies over 'and here'")

    def test_cut_by_the_page(self):
        self.panels[0].annotate("far away", (0, 0), xytext=(-80, 40), textcoords="offset points").set_in_layout(False)
        self.expect("'far away' is cut")

    def test_a_legend_cut_by_the_page(self):
        lines = list(self.panels[0].lines) * 4
        self.figure.suptitle(" ")
        self.figure.legend(lines, ["a name of the curve that is very long"] * 4, loc="upper center", ncol=4)
        found = problems(self.figure)
        self.assertTrue(any("a legend" in text and "is cut" in text for text in found), found)

    def test_a_legend_on_a_curve(self):
        self.panels[0].plot((0, 9), (77, 77), label="level")
        self.panels[0].legend(loc="upper left")
        self.expect("the legend covers", "'level'")

    def test_a_legend_on_a_panel(self):
        self.figure.legend(self.panels[0].lines, ["square"], loc="lower center", bbox_to_anchor=(0.3, 0.4))
        self.expect("the legend of the figure lies over the panel")

    def test_round_off(self):
        line = self.panels[1].lines[0]
        line.set_ydata(3e-12 * np.sin(line.get_xdata()))
        self.panels[1].relim()
        self.panels[1].autoscale_view()
        self.expect("panel 2", "ordinate", "round-off")

    def test_round_off_of_a_large_number(self):
        line = self.panels[1].lines[0]
        line.set_ydata(7.4e4 * (1 + 1e-14 * np.sin(line.get_xdata())))
        self.panels[1].set_ylim(7.4e4 - 1e-9, 7.4e4 + 1e-9)
        self.panels[1].set_yticks(())
        self.expect("round-off")

    def test_scripts_are_looked_at_while_they_draw(self):
        script = self.folder / "script.py"
        script.write_text("import matplotlib.pyplot as plt\nplt.subplots()\nplt.gcf().canvas.print_png('" + str(self.folder / "empty.png") + "')\n")
        done = draw(script)
        self.assertEqual(done.returncode, 0)
        self.assertIn("layout of empty.png: panel 1 (without words): holds no data", done.stderr)


if __name__ == "__main__":
    unittest.main()
