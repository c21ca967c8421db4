# SPDX-License-Identifier: GPL-3.0-only
"""Draws all pictures of scenes of params/ that run in a second or so: their layout, what their curves are, and that the pages name all
that the results hold."""

import re
import shutil

import numpy as np

from pictures import PictureTest
from real_results import real_result
import comparison
import pages
import plot
from sprag.results import read_result
from style import plt

FORCES = {"forces-over-x"}
IN_TIME = {*FORCES, "forces-over-time", "reversal", "energy"}
# Result -> its pictures.
PICTURES = {
    "closed-form-a": FORCES,
    "fig11": {"slope"},
    "model-b": {*FORCES, "contact"},
    "pair-a": {*FORCES, "contact", "fields", "pair"},
    "pair in time": {*IN_TIME, "pair"},
    "plate-reversal-a": {*IN_TIME, "contact", "fields", "sensors"},
    "plate-a": {*FORCES, "contact", "sensors"},
    "apparatus with frames": {*FORCES, "contact", "fields", "sensors"},
    "solid-pair-a": {*FORCES, "contact", "fields", "pair"},
    "sprag-slip-a": IN_TIME,
    "onset-a": {"growth", "cycle", "continuation"},
    "stability-a": {"critical", "modes", "stability"},
    "pair-stability-a": {"critical", "modes", "stability"},
    "jammed": {"stability"},
    "modal-a": {"modes"},
    "calibration-a": {"calibration"},
    "identification-a": {"identification"},
    "contact-law-a": {"contact-law"},
    "map-friction-depth-a": {"map"},
    "isolation-a": {"motion", "loop"},
    "isolation-free-a": {"motion", "loop"},
    "isolation-ground-a": {"motion", "loop", "spectra"},
    "study-transmissibility-a": {"study", "transmissibility"},
    "study-a": {"study", "trade", "convergence"},
    "study of many": {"study", "trade"},
    "judged": {"device", "judgements"},
    "front": {"device", "front"},
}
# One of each type, which are also drawn beside a copy.
COMPARED = {"model-b", "closed-form-a", "pair in time", "fig11", "stability-a", "modal-a", "calibration-a", "contact-law-a", "map-friction-depth-a", "isolation-a", "study-a", "onset-a"}
# Whose columns are described by the files alone.
OWN_COLUMNS = ("calibration-a", "identification-a", "study-a", "study-transmissibility-a", "study of many", "judged", "front")


def curve(axes, name):
    return next(line for line in axes.lines if line.get_label() == name)


class ScenesTest(PictureTest):
    def test_pictures_and_names(self):
        for name, names in PICTURES.items():
            result = real_result(name)
            with self.subTest(scene=name):
                self.assertEqual(pages.unknown_entries(result), [])
                if name not in OWN_COLUMNS:
                    self.assertEqual(pages.unknown_columns(result), [])
            pictures = plot.draw([result])
            self.assertEqual(set(pictures), names, name)
            for picture, figure in pictures.items():
                with self.subTest(scene=name, picture=picture):
                    self.expect_layout(figure)
                    check = getattr(self, f"check_{picture.replace('-', '_')}", None)
                    if check is not None:
                        check(result, figure.axes)
            plt.close("all")
            if name not in COMPARED:
                continue
            shutil.copytree(result.folder, self.folder / f"{name} again")
            compared = plot.draw([result, read_result(self.folder / f"{name} again")])
            for picture, figure in compared.items():
                with self.subTest(scene=name, compared=picture):
                    self.expect_layout(figure)
            plt.close("all")

    def expect_rows(self, result, line, column):
        """The curve is of rows of this column in their order."""
        drawn, values = line.get_ydata(), result.table[column]
        self.assertGreater(len(drawn), 1)
        first = np.flatnonzero([np.array_equal(values[i : i + len(drawn)], drawn, equal_nan=True) for i in range(len(values) - len(drawn) + 1)])
        self.assertGreater(len(first), 0, column)

    def check_pair(self, result, panels):
        columns = panels[0].get_subplotspec().get_gridspec().ncols
        for axes in panels[:columns]:
            self.expect_rows(result, curve(axes, "first lever"), "P")
            self.expect_rows(result, curve(axes, "second lever"), "P_2")
        for axes in panels[columns : 2 * columns]:
            self.expect_rows(result, curve(axes, "second lever"), "F_2")

    def check_sensors(self, result, panels):
        for axes in panels[:2]:
            self.expect_rows(result, curve(axes, "sum of the sensors"), "sensor_sum")
            self.expect_rows(result, curve(axes, "$P$ at the contact"), "P")
        self.assertEqual([line.get_label() for line in panels[2].lines if line.get_label().startswith("sensor")], [f"sensor {i}" for i in (1, 2, 3, 4)])

    def check_calibration(self, result, panels):
        names = [text.get_text() for text in panels[2].get_xticklabels()]
        heights = [patch.get_height() for patch in panels[2].patches]
        entries = [f"{name.replace(' ', '_frequency_')}{model}" for model in ("", "_beam") for name in names]
        self.assertEqual(sorted(heights), sorted(result.summary[entry] for entry in entries))

    def check_identification(self, result, panels):
        used = result.table["used"] > 0
        forward = used & (result.table["direction"] > 0)
        np.testing.assert_array_equal(curve(panels[0], "measured").get_ydata(), result.table["P"][used])
        np.testing.assert_array_equal(curve(panels[1], "forward").get_ydata(), result.table["P_residual"][forward])
        (image,) = [image for axes in panels for image in axes.images]
        np.testing.assert_array_equal(image.get_array(), result.groups["identification"]["correlation"])

    def check_front(self, result, panels):
        order = np.argsort(result.table["largest_force"][1:])
        pivot = result.table["geometry_pivot_distance"][1:][order]
        np.testing.assert_array_equal(panels[0].lines[0].get_ydata(), pivot)
        free = result.groups["free"]
        at = list(free["parameter"].astype(str)).index("Geometry/Pivot distance")
        share = 100 * (pivot - free["from"][at]) / (free["to"][at] - free["from"][at])
        np.testing.assert_allclose(panels[1].lines[at].get_ydata(), share)

    def check_judgements(self, result, panels):
        found = result.groups["judgements"]
        above = 100 * (found["damping_slope"] / found["expected_damping_slope"] - 1)
        self.assertTrue(any(np.allclose(line.get_ydata(), above) for line in panels[0].lines))

    def check_study(self, result, panels):
        """A curve for each of the other settings; many have a scale."""
        if result.folder.name == "study-a":
            self.assertEqual({len(axes.lines) for axes in panels}, {2})
            self.assertEqual([text.get_text() for text in panels[0].figure.legends[0].get_texts()], ["degree 1", "degree 2"])
            (line, above), table = panels[0].lines, result.table
            self.assertGreater(line.get_linewidth(), above.get_linewidth())  # which would hide it where they are equal
            self.assertNotEqual(line.get_linestyle(), above.get_linestyle())
            rows = (table["mesh_degree"] == 1) & (table["outcome"] == 0)
            np.testing.assert_array_equal(line.get_xdata(), np.sort(table["mesh_face_size"][rows]))

    def check_trade(self, result, panels):
        front = next(line for line in panels[0].lines if line.get_linestyle() == "-").get_xdata()
        self.assertTrue((np.diff(front) >= 0).all())

    def check_convergence(self, result, panels):
        """Lines of the runs' errors that fall at the orders beside them."""
        coarse, fine = (line for line in panels[0].lines)
        table, trade = result.table, result.groups["trade"]
        for line, degree in ((coarse, 1), (fine, 2)):
            rows = (table["mesh_degree"] == degree) & (table["outcome"] == 0)
            np.testing.assert_allclose(sorted(line.get_ydata()), sorted(100 * table["error_P"][rows]))
        orders = [order for text, order in zip(trade["order_of"].astype(str), trade["order"]) if text.startswith("P over")]
        said = " ".join(text.get_text() for text in panels[0].texts)
        self.assertEqual(said, f"order {min(orders):.2g} to {max(orders):.2g}")

    def check_modes(self, result, panels):
        """Growing modes are always shown."""
        said = [text.get_text() for axes in panels for text in (*axes.texts, axes.title, axes._left_title, axes._right_title)]
        growing = [text for text in said if "flutter" in text or "divergence" in text]
        self.assertEqual(len(growing), int((result.groups["modes"]["kind"] > 0).sum()), said)

    def check_critical(self, result, panels):
        """Lines at the limits; over the stroke a map whose shade ends there."""
        limits = [value for name, value in result.summary.items() if re.fullmatch(r"critical_.*_\d+", name)]
        drawn = [line.get_xdata()[0] for axes in panels for line in axes.lines]
        for limit in limits:
            self.assertTrue(np.isclose(drawn, limit, rtol=1e-12).any(), limit)
        if len(panels) > 1:
            shaded = [path.vertices[:, 0] for shade in panels[1].collections for path in shade.get_paths() if len(path.vertices) > 2]
            self.assertAlmostEqual(np.concatenate(shaded).max(), max(limits), delta=result.summary["critical_lever_depth_spacing"])

    def test_comparison_of_slides(self):
        results = [real_result(f"stability-b of {depth}") for depth in (8, 16)]
        pictures = plot.draw(results)
        self.assertEqual(set(pictures), {"modes", "numbers"})
        lines = {line.get_label(): line.get_xdata() for line in pictures["modes"].axes[0].lines}
        for name, result in zip(("8 mm", "16 mm"), results):
            self.assertEqual(max(lines[name]), result.summary["growth_rate"])

    def test_comparison_of_lever_depths_in_time(self):
        results = [real_result(f"reversal-a of {depth}") for depth in (6, 12, 20)]
        figure = comparison.comparison(results)
        self.assertIn("12 mm", [text.get_text() for text in figure.axes[1].texts])
        self.expect_layout(figure)
