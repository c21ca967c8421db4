# SPDX-License-Identifier: GPL-3.0-only
"""Picture of an identified lever, and tables made as a rig would measure them; run with /usr/bin/python3."""

import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import FOLDER, PictureTest, draw  # noqa: E402
import identification  # noqa: E402
import layout  # noqa: E402
import measure  # noqa: E402
from sprag.results import read_result  # noqa: E402
from test_plot import finish, make_run, new_file, put  # noqa: E402

ROWS = 120
CORRELATION = np.array(((1.0, -0.4, 0.3), (-0.4, 1.0, -0.99), (0.3, -0.99, 1.0)))


def make_identification(folder, forces=("P", "Q")):
    file = new_file(folder, "identification")
    table = file.create_group("table")
    generator = np.random.default_rng(1)
    x = np.concatenate((np.linspace(0, 65, ROWS // 2), np.linspace(65, 0, ROWS // 2)))
    direction = np.where(np.arange(ROWS) < ROWS // 2, 1.0, -1.0)
    used = np.where((x > 3) & ((direction > 0) | (x < 60)), 1.0, 0.0)
    columns = {"time": np.arange(ROWS) / 100, "x": x, "v": 112 * direction, "direction": direction, "used": used}
    summary = {}
    for force in forces:
        fitted = x * (0.2 if force == "P" else 0.15 * direction)
        residual = generator.normal(0, 0.1, ROWS)
        columns.update({force: fitted + residual, f"{force}_fitted": fitted, f"{force}_residual": residual})
        summary.update({f"noise_{force}": 0.1, f"values_{force}": used.sum(), f"effective_values_{force}": used.sum()})
    for name, values in columns.items():
        put(table, name, values, "N" if name[0] in "PQ" else "mm")
    group = file.create_group("identification")
    group["names"] = ["mu", "k", "th0"]
    put(group, "correlation", CORRELATION, "1")
    finish(file, **summary)
    return read_result(folder)


class IdentificationTest(PictureTest):
    def test_shows_what_was_measured_and_what_is_left(self):
        result = make_identification(self.folder / "a")
        panels = identification.identification(result).axes
        used = result.table["used"] > 0
        measured = next(line for line in panels[0].lines if line.get_label() == "measured")
        np.testing.assert_array_equal(measured.get_ydata(), result.table["P"][used])
        forward = used & (result.table["direction"] > 0)
        left = next(line for line in panels[1].lines if line.get_label() == "forward")
        np.testing.assert_array_equal(left.get_ydata(), result.table["P_residual"][forward])
        np.testing.assert_array_equal(panels[5].images[0].get_array(), CORRELATION)

    def test_layout_is_good(self):
        for forces in (("P", "Q"), ("Q",)):
            with self.subTest(forces=forces):
                result = make_identification(self.folder / "".join(forces), forces)
                self.assertEqual(layout.problems(identification.identification(result)), [])

    def test_plot_draws_it(self):
        make_identification(self.folder / "a")
        self.expect_picture(draw("plot.py", self.folder / "a"), "identification")

    def test_autocorrelation_is_that_of_the_noise(self):
        result = make_identification(self.folder / "a", ("Q",))
        noise = np.zeros(ROWS)
        noise[0] = 1
        for row in range(1, ROWS):
            noise[row] = 0.5 * noise[row - 1]
        result.table["Q_residual"] = noise
        result.table["used"] = np.ones(ROWS)
        result.table["direction"] = np.ones(ROWS)
        found = identification.autocorrelation(result, "Q")
        np.testing.assert_allclose(found[:5], 0.5 ** np.arange(5), rtol=1e-12)

    def test_measure_adds_noise_to_a_run(self):
        make_run(self.folder / "run")
        result = read_result(self.folder / "run")
        table = measure.measured(result, 1000, 0.1, 0.6, 1)
        exact = measure.measured(result, 1000, 0.0, 0.0, 1)
        noise = table["Q"] - exact["Q"]
        self.assertAlmostEqual(noise.std(), 0.1, delta=0.03)
        np.testing.assert_array_equal(table["x"], exact["x"])
        np.testing.assert_allclose(exact["Q"], np.interp(exact["time"], result.table["time"], result.table["Q"]))
        path = self.folder / "measured.csv"
        done = subprocess.run([sys.executable, FOLDER / "measure.py", self.folder / "run", "-o", path], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(path.read_text().splitlines()[0], "time [s], x [mm], P [N], Q [N]")


if __name__ == "__main__":
    unittest.main()
