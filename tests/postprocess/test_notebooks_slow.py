# SPDX-License-Identifier: GPL-3.0-only
"""The notebooks run, and find what another model or an integration of this file finds. Pictures stay in the folder SPRAG_PICTURES where
there is one."""

import contextlib
import io
import json
import math
import os
import shutil
import sys
from pathlib import Path

os.environ["MPLBACKEND"] = "Agg"
import matplotlib.pyplot as plt
import numpy as np

from runs import SOURCE, FolderTest

sys.path.insert(0, str(SOURCE / "postprocess"))
import sprag  # noqa: E402  # that of the sources, which stays when a notebook's copy goes

MOST_CELLS = 9  # titles among them
DEVICE = """
subsection Geometry
  set Cylinder radius  = 40
  set Interface offset = 22
  set Pivot distance   = 150
  set Pivot height     = 10
end

subsection Rotational spring
  set Stiffness = 4e4
end

subsection Drive
  set Stroke = 60
  set Speed  = 100
end

subsection Lever
  set Length          = 170
  set Depth           = 8
  set Width           = 30
  set Young's modulus = 210 GPa
  set Poisson's ratio = 0.3
  set Density         = 7850 kg/m3
  set Inertia         = as built
end

subsection Friction layer
  set Thickness = 3
end

subsection Friction
  set Law   = table
  set Table = mu.csv
end
"""

FRICTION = "speed [mm/s], mu\n1, 0.42\n10, 0.50\n30, 0.58\n100, 0.70\n300, 0.76\n"

MASS, STIFFNESS = 0.5, 12.6  # t, N/mm: 0.8 Hz

RECORD_STEP = 0.01  # s


def floor_record():
    """Acceleration of a floor [mm/s2] every RECORD_STEP: ground that resonates at 4 Hz, 60 lines from 0.2 to 19 Hz over 60 s."""
    random = np.random.default_rng(7)
    frequency = 0.2 * 1.08 ** np.arange(60)
    ratio = frequency / 4
    share = (0.8 * ratio) ** 2
    ground = np.sqrt((1 + share) / ((1 - ratio**2) ** 2 + share))
    amplitude = np.sqrt(frequency) * ground * frequency**2 / (0.8**2 + frequency**2)
    amplitude *= 150 / math.sqrt(np.sum(amplitude**2) / 2)
    phase = random.uniform(0, 2 * math.pi, len(frequency))
    time = RECORD_STEP * np.arange(6001)
    return time, np.sin(2 * math.pi * np.outer(time, frequency) + phase) @ amplitude


def transmissibility(acceleration, friction, parts=200):
    """Root mean square of the table's acceleration over the base's for constant friction [N]: steps of a part of RECORD_STEP by
    the semi-implicit Euler method, at each of which friction takes off what it can of the speed."""
    base = np.interp(np.arange(parts * (len(acceleration) - 1)) / parts, np.arange(len(acceleration)), acceleration)
    step, z, rate, squares = RECORD_STEP / parts, 0.0, 0.0, 0.0
    most = friction / MASS * step
    for value in base.tolist():
        before = rate
        rate -= (STIFFNESS / MASS * z + value) * step
        rate -= max(-most, min(most, rate))
        z += rate * step
        squares += ((rate - before) / step + value) ** 2
    return math.sqrt(squares / np.sum(base**2))


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
        (self.folder / "lever.prm").write_text(DEVICE, encoding="utf-8")
        (self.folder / "mu.csv").write_text(FRICTION, encoding="utf-8")
        found, printed = self.run_cells("my-device")
        stroke = found["sprag"].run(self.folder / "lever.prm", {"Lever/Depth": 7})
        self.assertEqual(found["thickness"], 7)
        self.assertAlmostEqual(found["critical"], 6.83, delta=0.05)
        self.assertEqual(found["judged"]["verdict"], "stable")
        # Held at many places both ways at all corners of the ranges; the same check sees a lever that is too thin.
        held = {"Stability/Position": range(2, 61, 2), "Stability/Direction": ["forward", "backward"], "Contact/Damping": [0.01, 0.1], "Friction/Factor": [0.8, 1.2]}
        changes = {"Study/Type": "stability", "Analysis/Model": "condensed", "Stability/Roles": "off", "Stability/Critical": "none"}
        for depth, sign in ((7, -1), (3.5, 1)):
            growth = sprag.sweep(self.folder / "lever.prm", held, {**changes, "Lever/Depth": depth}).table["growth_rate"]
            self.assertGreater(sign * growth.max(), 0)
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
        _, acceleration = floor_record()
        np.testing.assert_allclose(found["acceleration"], acceleration, atol=1e-9)
        self.assertEqual(found["design"].summary["meets_demands"], 1)
        best = {each.damper: each for each in found["dampers"]}
        without, lever = found["compared"]
        for each, friction in ((without, 0.0), (best["constant friction"], best["constant friction"].strength)):
            self.assertAlmostEqual(each.transmissibility / transmissibility(acceleration, friction), 1, delta=0.02, msg=each.damper)
        self.assertIn("The lever lets through", printed)
        self.assertAlmostEqual(lever.transmissibility, 0.498, delta=0.005)
        # A linear table's resonance curve.
        ratio = 2 * np.pi * np.array(found["frequencies"]) / np.sqrt(STIFFNESS / MASS)
        damping = best["viscous"].strength / np.sqrt(STIFFNESS * MASS) * ratio
        np.testing.assert_allclose(found["curves"]["viscous"], np.sqrt((1 + damping**2) / ((1 - ratio**2) ** 2 + damping**2)), rtol=1e-3)
