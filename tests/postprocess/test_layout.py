# SPDX-License-Identifier: GPL-3.0-only
"""Tests that each kind of bad layout is found, and none in a good picture; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw, problems  # noqa: E402
from style import plt  # noqa: E402


def label(figure, left, right):
    for axes in (left, right):
        axes.set(xlabel="x", ylabel="y")
        axes.legend(loc="upper left")


def empty(figure, left, right):
    right.lines[0].remove()
    right.set(xlim=(1, 2), ylabel="forgotten")


def say_why_it_is_empty(figure, left, right):
    empty(figure, left, right)
    right.annotate("nothing was written", (1.5, 0.5), ha="center")


def draw_a_line_across(figure, left, right):
    empty(figure, left, right)
    right.axhline(0.5)


def set_two_titles(figure, left, right):
    left.set_title("a title that is long, yes, long", loc="left")
    left.set_title("and another such title, no less", loc="right")


def write_beyond_the_page(figure, left, right):
    left.annotate("far away", (0, 0), xytext=(-80, 40), textcoords="offset points").set_in_layout(False)


def cover_a_curve(figure, left, right):
    left.plot((0, 9), (77, 77), label="level")
    left.legend(loc="upper left")


def show_round_off(figure, left, right):
    line = right.lines[0]
    line.set_ydata(3e-12 * np.sin(line.get_xdata()))
    right.relim()
    right.autoscale_view()


def show_round_off_beside_a_large_number(figure, left, right):
    line = right.lines[0]
    line.set_ydata(7.4e4 * (1 + 1e-14 * np.sin(line.get_xdata())))
    right.set_ylim(7.4e4 - 1e-9, 7.4e4 + 1e-9)
    right.set_yticks(())


GOOD = (label, say_why_it_is_empty)
# Each changes a figure of two panels; the words are of the one thing that is wrong then.
FAULTS = (
    (empty, ("panel 2", "forgotten", "no data")),
    (draw_a_line_across, ("no data",)),
    (lambda figure, left, right: left.set_xlim(20, 30), ("panel 1", "no data")),
    (set_two_titles, ("'a title that is long, yes, long' lies over 'and another such title, no less'",)),
    (lambda figure, left, right: left.set_xticks((4, 5), ("many words here", "and here")), ("'many words here' lies over 'and here'",)),
    (write_beyond_the_page, ("'far away' is cut",)),
    (cover_a_curve, ("the legend covers", "'level'")),
    (
        lambda figure, left, right: figure.legend(left.lines, ["square"], loc="lower center", bbox_to_anchor=(0.3, 0.4)),
        ("the legend of the figure lies over the panel",),
    ),
    (show_round_off, ("panel 2", "ordinate", "round-off")),
    (show_round_off_beside_a_large_number, ("round-off",)),
)


class LayoutTest(PictureTest):
    def figure(self):
        figure, panels = plt.subplots(1, 2, figsize=(6, 3))
        for axes in panels:
            axes.plot(np.arange(10.0), np.arange(10.0) ** 2, label="square")
        return figure, *panels

    def test_good_figures(self):
        for act in GOOD:
            figure, *panels = self.figure()
            act(figure, *panels)
            self.expect_layout(figure)

    def test_faults(self):
        for act, words in FAULTS:
            with self.subTest(words):
                figure, *panels = self.figure()
                act(figure, *panels)
                found = problems(figure)
                self.assertEqual(len(found), 1, found)
                for word in words:
                    self.assertIn(word, found[0])

    def test_a_legend_cut_by_the_page(self):
        figure, left, _ = self.figure()
        figure.suptitle(" ")
        figure.legend(list(left.lines) * 4, ["a name of the curve that is very long"] * 4, loc="upper center", ncol=4)
        found = problems(figure)
        self.assertTrue(any("a legend" in text and "is cut" in text for text in found), found)

    def test_scripts_are_looked_at_while_they_draw(self):
        script = self.folder / "script.py"
        script.write_text("import matplotlib.pyplot as plt\nplt.subplots()\nplt.gcf().canvas.print_png('" + str(self.folder / "empty.png") + "')\n")
        done = draw(script)
        self.assertEqual(done.returncode, 0)
        self.assertIn("layout of empty.png: panel 1 (without words): holds no data", done.stderr)


if __name__ == "__main__":
    unittest.main()
