# SPDX-License-Identifier: GPL-3.0-only
"""Names of several results and pictures of many of them, on copies of one run."""

import shutil
import unittest

import h5py
import numpy as np

from pictures import PictureTest, draw
import comparison
import overlays
from sprag import parameters
import several
from sprag.results import read_result
from real_results import run_once

LISTING = """# Listing of Parameters
subsection Analysis
  set Type = quasi-static
  # Rigid or deformable: one of rigid |
  # beam.
  set Model = {model}
end
subsection Friction
  # mu of the Coulomb law [-]: a number >= 0.
  set Coefficient = {mu}  # default: 0.73
end
subsection Lever
  # Depth of the metal, without the friction
  # layer [mm]: a number > 0.
  set Depth = {depth}
end
subsection Output
  # Travel of x [mm]: a number > 0.
  set Field interval = {interval}
end
"""


def listing(**changes):
    return LISTING.format(**{"model": "beam", "mu": "0.73", "depth": "20", "interval": "5", **changes})


class SeveralTest(PictureTest):
    def write_run(self, name, factor=1.0, scene="closed-form-a", **changes):
        """Forces grow with the factor."""
        folder = shutil.copytree(run_once(scene), self.folder / name)
        with h5py.File(folder / "result.h5", "r+") as file:
            del file["parameters"]
            file["parameters"] = listing(**changes)
            for column in ("P", "Q"):
                file[f"table/{column}"][:] *= factor
                del file[f"table/{column}_closed_form"]
        return read_result(folder)

    def depths(self, number):
        return [self.write_run(f"run{i}", 1 + i, depth=str(5 + 2 * i)) for i in range(number)]


class ParametersTest(unittest.TestCase):
    def test_what_differs(self):
        same = [parameters.parse(text) for text in (listing(), listing(mu="7.3e-1", interval="3"))]
        self.assertEqual(parameters.differing(same), [])
        others = [*same, parameters.parse(listing(depth="6", model="rigid"))]
        self.assertEqual(parameters.differing(others), ["Analysis/Model", "Lever/Depth"])


class TellingApart(SeveralTest):
    def test_long_names_are_not_cut(self):
        result = self.write_run("a")
        text = result.parameters.replace("subsection Lever\n", "subsection Friction layer\n").replace("set Depth", "set Young's modulus")
        result.parameters, other = text, self.write_run("b", 2)
        other.parameters = text.replace("modulus = 20", "modulus = 30")
        names = "critical_rotational_spring_stiffness_1", "peak_P_forward", "loop_area"
        for each in (result, other):
            each.summary[names[0]] = each.summary["loop_area"]
        figure = overlays.numbers([result, other], names)
        self.assertEqual(figure.axes[0].get_xlabel().replace("\n", " "), "friction layer Young's modulus [mm]")
        self.expect_layout(figure)


class Pictures(SeveralTest):
    def test_few_devices_have_labels_at_their_curves(self):
        figure = comparison.comparison(self.depths(3))
        normal, tangential, *numbers = figure.axes
        self.assertEqual([text.get_text() for text in tangential.texts], ["5 mm", "7 mm", "9 mm"])
        self.assertEqual([text.get_color() for text in tangential.texts], [line.get_color() for line in tangential.lines[:3]])
        self.assertIsNone(normal.get_legend())
        np.testing.assert_allclose(numbers[1].lines[0].get_xdata(), [5, 7, 9])
        self.expect_layout(figure)

    def test_many_devices_have_a_colour_bar(self):
        figure = comparison.comparison(self.depths(20))
        self.assertEqual(figure.axes[-1].get_ylabel(), "lever depth [mm]")
        self.assertEqual(len(figure.axes[0].lines), 21)  # and the line of zero
        self.assertEqual(figure.axes[1].texts[:], [])
        self.expect_layout(figure)

    def test_levels_have_deviations_from_the_finest(self):
        results = [self.write_run(model, 1 + 0.01 * i, model=model) for i, model in enumerate(("rigid", "finite element", "beam"))]
        figure = comparison.comparison(results)
        self.assertEqual(figure.axes[2].get_title(loc="right"), "deviation from finite element")
        self.assertEqual(len(figure.axes[2].lines), 2)
        self.expect_layout(figure)

    def test_pressure_at_equal_x(self):
        """The second face is as the first but for its size; steps that miss x are shifted by what they miss."""
        results = [self.write_run(name, scene="model-b", depth=depth) for name, depth in (("a", "6"), ("b", "8"))]
        with h5py.File(results[1].folder / "result.h5", "r+") as file:
            file["face/pressure"][:] *= 1.5
        pictures = comparison.comparisons(results)
        self.assertEqual(set(pictures), {"comparison", "pressure"})
        forward = pictures["pressure"].axes[0]
        first, second = (line.get_xydata() for line in forward.lines[:2])
        np.testing.assert_allclose(second, first * (1, 1.5))
        difference = pictures["pressure"].axes[4].lines[1].get_ydata()
        np.testing.assert_allclose(difference, 0.5 * first[:, 1], atol=1e-12)
        self.expect_layout(pictures["pressure"])
        # The finest of models is the reference.
        levels = (("coarse", "rigid"), ("fine", "beam"))
        models = comparison.pressures([self.write_run(name, scene="model-b", model=model) for name, model in levels])
        self.assertEqual(models.axes[4].get_title(loc="left"), "pressure less that of beam")

    def test_what_differs_names_the_runs(self):
        two = [self.write_run(name, mu=mu, depth=depth) for name, mu, depth in (("a", "0.5", "6"), ("b", "0.7", "6"), ("c", "0.7", "8"))]
        self.assertEqual(several.distinguish(two).names, ["0.5, 6 mm", "0.7, 6 mm", "0.7, 8 mm"])

    def test_script(self):
        for target, options, names in (
            (self.pictures / "levels.pdf", (), ["levels.pdf"]),
            (self.pictures / "all", ("--format", "png,svg"), ["all.png", "all.svg", "levels.pdf"]),
        ):
            self.silent(draw("comparison.py", run_once("closed-form-a"), run_once("reversal-a of 6"), "-o", target, *options))
            self.assertEqual(sorted(path.name for path in self.pictures.iterdir()), names)
