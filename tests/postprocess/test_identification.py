# SPDX-License-Identifier: GPL-3.0-only
"""Residuals of an identified lever, and tables made as a rig would measure them."""

import subprocess
import sys

import numpy as np

from pictures import FOLDER, PictureTest
from real_results import real_result, run_once
import identification
import measure


class IdentificationTest(PictureTest):
    def test_autocorrelation_is_that_of_the_noise(self):
        result = real_result("identification-a")
        rows = len(result.table["used"])
        result.table["Q_residual"] = 0.5 ** np.arange(rows)
        result.table["used"] = result.table["direction"] = np.ones(rows)
        found = identification.autocorrelation(result, "Q")
        np.testing.assert_allclose(found[:5], 0.5 ** np.arange(5), rtol=1e-12)

    def test_measure_adds_noise_to_a_run(self):
        result = real_result("closed-form-a")
        table = measure.measured(result, 1000, 0.1, 0.6, 1)
        exact = measure.measured(result, 1000, 0.0, 0.0, 1)
        noise = table["Q"] - exact["Q"]
        self.assertAlmostEqual(noise.std(), 0.1, delta=0.03)
        np.testing.assert_array_equal(table["x"], exact["x"])
        np.testing.assert_allclose(exact["Q"], np.interp(exact["time"], result.table["time"], result.table["Q"]))
        path = self.folder / "measured.csv"
        done = subprocess.run([sys.executable, FOLDER / "measure.py", run_once("closed-form-a"), "-o", path], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(path.read_text().splitlines()[0], "time [s], x [mm], P [N], Q [N]")
