# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of studies on small files of the shape sprag writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest  # noqa: E402
from sprag import results  # noqa: E402
import study  # noqa: E402
from style import plt  # noqa: E402
from test_plot import put  # noqa: E402

SIZES = ("0.5", "1", "2")
DEGREES = ("1", "2")


def make_study(folder, reference=True, many=0):
    """Face sizes of two degrees; the last run is refused. With `many` that many depths as well."""
    folder.mkdir()
    depths = [str(10 + i) for i in range(many)] or [None]
    rows = [(size, degree, depth) for depth in depths for degree in DEGREES for size in SIZES]
    vary = "Mesh/Degree = 1, 2; Mesh/Face  size = 0.5, 1, 2" + ("; Lever/Depth = 10 ... 20 : 11" if many else "")
    with h5py.File(folder / "result.h5", "w") as file:
        file.attrs["format"] = "sprag result"
        file["parameters"] = f"subsection Analysis\n  set Type = study\nend\n\nsubsection Study\n  set Type = quasi-static\n  set Vary = {vary}\nend\n"
        size, degree = (np.array([float(row[i]) for row in rows]) for i in (0, 1))
        outcome = np.zeros(len(rows))
        outcome[-1] = 2
        table = file.create_group("table")
        error = np.where(outcome == 0, size ** (degree + 1) / 100, np.nan)
        put(table, "run", np.arange(len(rows), dtype=float))
        put(table, "outcome", outcome)
        put(table, "cpu_time", degree / size, "s")
        put(table, "mesh_face_size", size, "mm")
        put(table, "mesh_degree", degree)
        put(table, "loop_area", 600 * (1 + error), "N mm")
        put(table, "peak_P_forward", 10 * (1 + error), "N")
        if reference:
            put(table, "error_P", error)
            put(table, "pareto_P", (error < 0.05).astype(float))
        file["headlines/name"] = ["peak_P_forward", "loop_area"]
        runs = file.create_group("runs")
        put(runs, "mesh_face_size", [row[0] for row in rows], "")
        put(runs, "mesh_degree", [row[1] for row in rows], "")
        if many:
            put(table, "lever_depth", [float(row[2]) for row in rows], "mm")
            put(runs, "lever_depth", [row[2] for row in rows], "")
        file.create_group("summary")
        file.create_group("meta")
    return folder


class StudyTest(PictureTest):
    def test_parameters_are_those_that_are_varied(self):
        result = results.read_result(make_study(self.folder / "run"))
        varied = study.varied_parameters(result)
        self.assertEqual([parameter.name for parameter in varied], ["Mesh/Degree", "Mesh/Face size"])
        self.assertEqual(study.choose_abscissa(varied).name, "Mesh/Face size")
        self.assertEqual(study.choose_abscissa(varied).label, "face size [mm]")

    def test_a_curve_for_each_of_the_other_settings(self):
        result = results.read_result(make_study(self.folder / "run"))
        figure = study.curves(result)
        self.assertEqual([len(axes.lines) for axes in figure.axes], [2, 2])
        first = figure.axes[0].lines[0]
        np.testing.assert_array_equal(first.get_xdata(), [0.5, 1, 2])
        np.testing.assert_allclose(first.get_ydata(), 10 * (1 + np.array([0.25, 1, 4]) / 100))
        names = [text.get_text() for text in figure.legends[0].get_texts()]
        self.assertEqual(names, ["degree 1", "degree 2"])

    def test_many_settings_have_a_scale(self):
        result = results.read_result(make_study(self.folder / "run", many=11))
        figure = study.curves(result)
        self.assertEqual(len(figure.axes[0].lines), 6)  # sizes as colours, degrees as lines, over the depth
        self.assertEqual(len(figure.axes), 2)

    def test_the_front_goes_by_cost(self):
        result = results.read_result(make_study(self.folder / "run"))
        axes = study.trade(result).axes[0]
        front = next(line for line in axes.lines if line.get_linestyle() == "-")
        self.assertTrue((np.diff(front.get_xdata()) >= 0).all())
        np.testing.assert_allclose(sorted(front.get_ydata()), sorted(100 * np.array([0.0025, 0.01, 0.04, 0.00125, 0.01])))

    def test_labels_of_logarithms_stay_apart(self):
        for low in (0.14, 2.1):
            for ratio in (1.1, 3, 4.9, 5.1, 20, 1e4):
                figure, axes = plt.subplots(figsize=(2, 2))
                axes.loglog((low, low * ratio), (low, low * ratio), "o")
                for axis in (axes.xaxis, axes.yaxis):
                    study.plain_logarithms(axis)
                with self.subTest(low=low, ratio=ratio):
                    self.expect_layout(figure)
                    self.assertGreaterEqual(sum(low <= tick <= low * ratio for tick in axes.get_xticks()), 1)
                plt.close(figure)

    def test_pictures(self):
        self.expect_pictures(self.plot(make_study(self.folder / "run")), ["study.png", "trade.png"])
        self.pictures = self.folder / "others"
        self.expect_pictures(self.plot(make_study(self.folder / "without", reference=False)), ["study.png"])
        (self.folder / "cut").mkdir()
        (self.folder / "cut" / "study.journal").touch()
        self.expect_refusal(self.plot(self.folder / "cut"), "study", "cut short")


if __name__ == "__main__":
    unittest.main()
