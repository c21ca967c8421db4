# SPDX-License-Identifier: GPL-3.0-only
"""The notebooks run, and find what the users of tests/robustness/users_slow.py find, whose devices they have; run with /usr/bin/python3.
Environment: SPRAG, the program, SPRAG_SOURCE, the sources. Pictures stay in the folder SPRAG_PICTURES where there is one."""

import contextlib
import io
import json
import os
import shutil
import sys
import unittest
from pathlib import Path

os.environ["MPLBACKEND"] = "Agg"
import matplotlib.pyplot as plt
import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / folder) for folder in ("support", "robustness")]
import users_slow  # noqa: E402
from runs import SOURCE, FolderTest  # noqa: E402

MOST_CELLS = 9  # titles among them


class Notebooks(FolderTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(SOURCE / "postprocess", self.folder / "postprocess", ignore=shutil.ignore_patterns("pictures", "__pycache__"))
        (self.folder / "params").symlink_to(SOURCE / "params")

    def run_cells(self, name):
        """Returns the variables that a notebook leaves."""
        path = self.folder / "postprocess" / "notebooks" / f"{name}.ipynb"
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        self.assertLessEqual(len(cells), MOST_CELLS)
        found: dict = {}
        printed = io.StringIO()
        with contextlib.chdir(path.parent), contextlib.redirect_stdout(printed):
            for number, cell in enumerate(cell for cell in cells if cell["cell_type"] == "code"):
                self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))
                exec(compile("".join(cell["source"]), f"{name}, cell {number}", "exec"), found)
                if plt.get_fignums() and (pictures := os.environ.get("SPRAG_PICTURES")):
                    plt.savefig(Path(pictures) / f"{name}-{number}.png", dpi=100)
                plt.close("all")
        return found, printed.getvalue()

    def test_my_device(self):
        (self.folder / "lever.prm").write_text(users_slow.DEVICE, encoding="utf-8")
        (self.folder / "mu.csv").write_text(users_slow.FRICTION, encoding="utf-8")
        found, printed = self.run_cells("my-device")
        stroke = found["sprag"].run(self.folder / "lever.prm", {"Lever/Depth": 7})
        self.assertEqual(found["thickness"], 7)
        self.assertAlmostEqual(found["critical"], 6.83, delta=0.05)
        self.assertEqual(found["judged"]["verdict"], "stable")
        self.assertAlmostEqual(found["stroke"].summary["peak_Q_forward"] / stroke.summary["peak_Q_forward"], 1, delta=1e-9)
        self.assertTrue((self.folder / "postprocess/notebooks/my-device/report.html").is_file(), printed)

    def test_verify_contact(self):
        found, _ = self.run_cells("verify-contact")
        for name, tolerance in (("friction_work", 1e-3), ("largest_pressure", 1e-2)):
            self.assertAlmostEqual(found["differences"][name], 0, delta=tolerance, msg=name)
        self.assertLess(max(found["apart"].values()), 0.03)
        self.assertEqual(set(found["orders"]), {"P", "Q", "loop_area", "largest_pressure"})
        self.assertGreater(min(found["orders"].values()), 1.4)

    def test_isolate_my_machine(self):
        found, printed = self.run_cells("isolate-my-machine")
        _, acceleration = users_slow.floor_record()
        np.testing.assert_allclose(found["acceleration"], acceleration, atol=1e-9)
        self.assertEqual(found["design"].summary["meets_demands"], 1)
        best = {each.damper: each for each in found["dampers"]}
        without, lever = found["compared"]
        for each, friction in ((without, 0.0), (best["constant friction"], best["constant friction"].strength)):
            self.assertAlmostEqual(each.transmissibility / users_slow.transmissibility(acceleration, friction), 1, delta=0.02, msg=each.damper)
        self.assertIn("The lever lets through", printed)
        self.assertAlmostEqual(lever.transmissibility, 0.498, delta=0.005)
        # A linear table's resonance curve.
        ratio = 2 * np.pi * np.array(found["frequencies"]) / np.sqrt(users_slow.STIFFNESS / users_slow.MASS)
        damping = best["viscous"].strength / np.sqrt(users_slow.STIFFNESS * users_slow.MASS) * ratio
        np.testing.assert_allclose(found["curves"]["viscous"], np.sqrt((1 + damping**2) / ((1 - ratio**2) ** 2 + damping**2)), rtol=1e-3)


if __name__ == "__main__":
    unittest.main()
