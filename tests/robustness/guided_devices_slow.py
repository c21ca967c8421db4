# SPDX-License-Identifier: GPL-3.0-only
"""Devices other than the press of params/own-device.md by the search of its step 3: a lever of the depth found plus its error is stable
in slides close to one another over stroke and ranges, one of 5 % less depth is not.
Run with /usr/bin/python3; environment: SPRAG, the program, and SPRAG_SOURCE, the sources."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import TIMEOUT, RunTest, sets, sprag  # noqa: E402

RANGES = {"Contact/Damping": (0.01, 0.1), "Friction/Factor": (0.8, 1.2)}
SLIDES = 400


def scene(**sections):
    """Text of a scene: {section: {parameter: value}}, blanks of names as underscores."""
    return "".join(
        f"subsection {section.replace('_', ' ')}\n" + "".join(f"  set {name} = {value}\n" for name, value in entries.items()) + "end\n"
        for section, entries in sections.items()
    )


CORK = scene(
    Geometry={"Cylinder radius": 40, "Interface offset": 22, "Pivot distance": 150, "Pivot height": 10},
    Rotational_spring={"Stiffness": 4e4},
    Lever={"Made of": "steel", "Length": 170, "Depth": 4, "Width": 30, "Inertia": "as built"},
    Friction_layer={"Made of": "cork", "Thickness": 3},
)
POLYURETHANE = scene(
    Geometry={"Cylinder radius": 25, "Interface offset": 10, "Pivot distance": 100, "Pivot height": 0},
    Rotational_spring={"Stiffness": 1.5e4},
    Drive={"Stroke": 30, "Speed": 80},
    Lever={"Made of": "aluminium", "Length": 115, "Depth": 4, "Width": 20, "Inertia": "as built"},
    Friction_layer={"Made of": "polyurethane", "Thickness": 2},
    Friction={"Law": "Coulomb", "Coefficient": 0.7},
)


class GuidedDevices(RunTest):
    def run_device(self, text, changes):
        file = self.folder / "device.prm"
        file.write_text(text, encoding="utf-8")
        done = sprag(file, *sets({"Analysis/Model": "condensed", **changes}), "--quiet", "--output", self.output, "--overwrite", timeout=3 * TIMEOUT)
        self.assertEqual(done.returncode, 0, done.stderr)

    def growth_rates(self, text, depth, stroke):
        """Returns that of each slide: closely over x, both ways, with ends and middles of the ranges."""
        rng = np.random.default_rng(43)
        constants = {name: rng.choice([low, np.sqrt(low * high), high], SLIDES) for name, (low, high) in RANGES.items()}
        x = np.repeat(np.linspace(0.02 * stroke, stroke, SLIDES // 2), 2)
        vary = {"Stability/Position": x, "Stability/Direction": ["forward", "backward"] * (SLIDES // 2), **constants}
        lists = "; ".join(f"{name} = {', '.join(map(str, values))}" for name, values in vary.items())
        study = {"Analysis/Type": "study", "Study/Type": "stability", "Study/Combine": "list", "Stability/Critical": "none", "Stability/Roles": "off"}
        self.run_device(text, {**study, "Lever/Depth": depth, "Study/Vary": lists})
        return self.read("table", "growth_rate")["growth_rate"]

    def check(self, text, depth, error, stroke):
        ranges = "; ".join(f"{name} {low} {high}" for name, (low, high) in RANGES.items())
        self.run_device(text, {"Analysis/Type": "stability", "Stability/Ranges": ranges, "Stability/Critical": "Lever/Depth 2 12"})
        summary = self.read("summary")
        self.assertAlmostEqual(summary["critical_lever_depth_1"], depth, delta=0.02)
        self.assertAlmostEqual(summary["critical_lever_depth_1_error"], error, delta=0.3 * error)
        limit = summary["critical_lever_depth_1"]
        self.assertLess(self.growth_rates(text, limit + summary["critical_lever_depth_1_error"], stroke).max(), 0)
        self.assertGreater(self.growth_rates(text, 0.95 * limit, stroke).max(), 0)

    def test_cork_on_steel(self):
        self.check(CORK, 5.235, 0.12, 65)

    def test_polyurethane_on_aluminium(self):
        self.check(POLYURETHANE, 6.672, 0.27, 30)


if __name__ == "__main__":
    unittest.main()
