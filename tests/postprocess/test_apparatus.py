# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of force sensors and of calibrations; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import calibration  # noqa: E402
import sensors  # noqa: E402
from sprag.results import read_result  # noqa: E402
from test_plot import fill_run, finish, make_run, make_transient, new_file, put  # noqa: E402

SHARES = np.array((0.1, 0.4, 0.3, 0.2))


def add_sensors(file, total):
    for number, share in enumerate(SHARES, 1):
        put(file["table"], f"sensor_{number}", share * total, "N")
    put(file["table"], "sensor_sum", total, "N")


def make_static(folder):
    file = new_file(folder)
    fill_run(file, np.concatenate((np.arange(0.0, 11), np.arange(10.0, -1, -1))))
    add_sensors(file, file["table/P"][:] + 0.25)
    finish(file)
    return read_result(folder)


def make_dynamic(folder):
    file = make_transient(folder)
    P = file["table/P"][:]
    add_sensors(file, np.convolve(P, np.ones(9) / 9, "same"))
    finish(file)
    return read_result(folder)


FREQUENCIES = {"free_frequency_1": (40.0, 40.4), "free_frequency_2": (700.0, 686.0), "contact_frequency_1": (290.0, 293.0)}


def make_calibration(folder):
    file = new_file(folder, "calibration")
    table = file.create_group("table")
    x = np.tile((16.25, 32.5, 48.75), 2)
    direction = np.repeat((1.0, -1.0), 3)
    P = x * np.where(direction > 0, 0.2, 0.4)
    columns = {"x": x, "direction": direction, "P": P, "P_beam": 1.01 * P, "Q": 0.8 * direction * P, "Q_beam": 0.81 * direction * P}
    for name, values in columns.items():
        put(table, name, values, "N" if name[0] in "PQ" else "mm")
    summary = {"stiffness": 7.4e4, "moment_of_inertia": 6.45, "P_deviation": 0.01, "Q_deviation": 0.0125}
    for name, (mesh, beam) in FREQUENCIES.items():
        summary.update({name: mesh, f"{name}_beam": beam, f"{name}_deviation": beam / mesh - 1})
    finish(file, **summary)
    return read_result(folder)


class ApparatusTest(PictureTest):
    def test_sensors_over_x(self):
        result = make_static(self.folder / "a")
        panels = sensors.sensor_forces(result).axes
        forward = slice(0, 11)
        curves = {line.get_label(): line.get_xydata() for line in panels[0].lines}
        x, total, P = (result.table[name][forward] for name in ("x", "sensor_sum", "P"))
        np.testing.assert_array_equal(curves["sum of the sensors"], np.column_stack((x, total)))
        np.testing.assert_array_equal(curves["$P$ at the contact"], np.column_stack((x, P)))
        np.testing.assert_array_equal(panels[1].lines[0].get_ydata(), result.table["P"][12:])  # backward
        for difference in panels[4:]:
            np.testing.assert_allclose(difference.lines[0].get_ydata(), 0.25, rtol=1e-12)
        each = panels[2]
        names = [line.get_label() for line in each.lines if line.get_label().startswith("sensor")]
        self.assertEqual(names, ["sensor 1", "sensor 2", "sensor 3", "sensor 4"])
        self.expect_picture(draw("plot.py", self.folder / "a"), "sensors")

    def test_sensors_left_and_right(self):
        make_static(self.folder / "a")
        with h5py.File(self.folder / "a/result.h5", "r+") as file:
            for side, share in (("left", 0.25), ("right", 0.75)):
                put(file["table"], f"sensor_2_{side}", share * file["table/sensor_2"][:], "N")
        result = read_result(self.folder / "a")
        each = [line for line in sensors.sensor_forces(result).axes[2].lines if line.get_label().startswith("sensor")]
        self.assertEqual([line.get_label() for line in each], ["sensor 1", "sensor 2 left", "sensor 2 right", "sensor 3", "sensor 4"])
        np.testing.assert_allclose(each[2].get_ydata(), 3 * each[1].get_ydata())
        self.assertEqual(each[1].get_color(), each[2].get_color())
        self.assertNotEqual(each[1].get_linestyle(), each[2].get_linestyle())

    def test_sensors_over_time_with_the_reversal(self):
        result = make_dynamic(self.folder / "a")
        panels = sensors.sensor_forces(result).axes
        self.assertEqual(len(panels), 6)
        np.testing.assert_array_equal(panels[0].lines[0].get_xdata(), result.table["time"])
        near = panels[1].lines[0].get_xdata()
        self.assertAlmostEqual(near[0], -3, delta=0.1)  # ms
        self.expect_layout(panels[0].figure)

    def test_no_sensors_no_picture(self):
        make_run(self.folder / "a")
        self.assertFalse(sensors.has_sensors(read_result(self.folder / "a")))

    def test_ten_sensors_in_their_order(self):
        result = make_static(self.folder / "a")
        result.table["sensor_10"] = result.table["sensor_1"]
        self.assertEqual(sensors.sensor_columns(result), ["sensor_1", "sensor_2", "sensor_3", "sensor_4", "sensor_10"])

    def test_calibration(self):
        result = make_calibration(self.folder / "a")
        figure = calibration.calibration(result)
        normal, along, bars = figure.axes
        backward_beam = normal.lines[3].get_xydata()
        np.testing.assert_allclose(backward_beam, np.column_stack(((16.25, 32.5, 48.75), 1.01 * 0.4 * np.array((16.25, 32.5, 48.75)))))
        self.assertIn("1.2 %", along.get_title(loc="right"))
        self.assertEqual([text.get_text() for text in bars.get_xticklabels()], ["free 1", "free 2", "contact 1"])
        heights = sorted(patch.get_height() for patch in bars.patches)
        self.assertEqual(heights, sorted(value for pair in FREQUENCIES.values() for value in pair))
        self.assertIn("-2 %", " ".join(text.get_text() for text in bars.texts))
        self.expect_picture(draw("plot.py", self.folder / "a"), "calibration")


if __name__ == "__main__":
    unittest.main()
