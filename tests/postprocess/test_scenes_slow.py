# SPDX-License-Identifier: GPL-3.0-only
"""Scenes of params/ that run in a second or so: the layout of all their pictures, and that the pages name all that their results hold.
contact_sheet.py looks at the pictures of every scene. Run with /usr/bin/python3."""

import os
import shutil
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import SOURCE, PictureTest  # noqa: E402
import comparison  # noqa: E402
import pages  # noqa: E402
import plot  # noqa: E402
from sprag import program  # noqa: E402
from sprag.results import read_result  # noqa: E402
from style import plt  # noqa: E402

SCENES = Path(os.environ.get("SPRAG_SOURCE", SOURCE)) / "params"
COARSE = {"Mesh/Face size": 2}
WITHOUT_FIELDS = {**COARSE, "Output/Fields": "none"}
FORCES = {"forces-over-x"}
IN_TIME = {*FORCES, "forces-over-time", "reversal", "energy"}
# Scene -> its settings here and its pictures.
PICTURES = {
    "closed-form-a": ({}, FORCES),
    "fig11": ({"Slope/Offset ratios": ", ".join(f"{i / 12:g}" for i in range(11))}, {"slope"}),
    "model-b": (WITHOUT_FIELDS, {*FORCES, "contact"}),
    "pair-a": (COARSE, {*FORCES, "contact", "fields", "pair"}),
    "plate-reversal-a": (COARSE, {*IN_TIME, "contact", "fields", "sensors"}),
    "plate-a": (WITHOUT_FIELDS, {*FORCES, "contact", "sensors"}),
    "sprag-slip-a": ({}, IN_TIME),
    "pair-stability-a": ({"Stability/Critical": "Friction/Factor 0.9 1.1"}, {"critical", "modes", "stability"}),
    "modal-a": (COARSE, {"modes"}),
    "calibration-a": ({"Mesh/Face size": 4}, {"calibration"}),
    "identification-a": ({}, {"identification"}),
    "contact-law-a": (COARSE, {"contact-law"}),
    "map-friction-depth-a": ({"Map/First points": 4, "Map/Second points": 4, "Map/Coarsest": 1, "Map/Bisections": 1}, {"map"}),
    "isolation-a": ({}, {"motion", "loop"}),
    "isolation-free-a": ({"Isolation/Damper": "constant friction"}, {"motion", "loop"}),
    "isolation-ground-a": ({"Isolation/Duration": 20}, {"motion", "loop", "spectra"}),
    "study-transmissibility-a": (
        {"Study/Vary": "Isolation/Damper = lever, constant friction, Beucke; Isolation/Base frequency = 0.5 ... 2 : 9"},
        {"study", "transmissibility"},
    ),
    "study-a": (
        {"Study/Vary": "Mesh/Degree = 1, 2; Mesh/Face size = 2, 4", "Study/Reference": "Mesh/Face size = 1"},
        {"study", "trade"},
    ),
}
# Whose columns are described by the files alone.
OWN_COLUMNS = ("calibration-a", "identification-a", "study-a", "study-transmissibility-a")


class ScenesTest(PictureTest):
    def run_result(self, scene, changes, name=None):
        folder = self.folder / (name or scene)
        program.run_scene(program.program(), SCENES / f"{scene}.prm", folder, changes)
        return read_result(folder)

    def test_pictures_and_names(self):
        for scene, (changes, names) in PICTURES.items():
            result = self.run_result(scene, changes)
            with self.subTest(scene=scene):
                self.assertEqual(pages.unknown_entries(result), [])
                if scene not in OWN_COLUMNS:
                    self.assertEqual(pages.unknown_columns(result), [])
            pictures = plot.draw([result])
            self.assertEqual(set(pictures), names)
            for name, figure in pictures.items():
                with self.subTest(scene=scene, picture=name):
                    self.expect_layout(figure)
            plt.close("all")
            # Any result has something in common with one of its own type.
            shutil.copytree(result.folder, self.folder / f"{scene} again")
            compared = plot.draw([result, read_result(self.folder / f"{scene} again")])
            for name, figure in compared.items():
                with self.subTest(scene=scene, compared=name):
                    self.expect_layout(figure)
            plt.close("all")

    def test_comparison_of_slides(self):
        results = [self.run_result("stability-b", {"Lever/Depth": depth, "Stability/Critical": "none"}, f"d{depth}") for depth in (8, 16)]
        pictures = plot.draw(results)
        self.assertEqual(set(pictures), {"modes", "numbers"})
        lines = {line.get_label(): line.get_xdata() for line in pictures["modes"].axes[0].lines}
        for name, result in zip(("8 mm", "16 mm"), results):
            self.assertEqual(max(lines[name]), result.summary["growth_rate"])

    def test_comparison_of_lever_depths_in_time(self):
        results = [self.run_result("reversal-a", {"Lever/Depth": depth}, f"d{depth}") for depth in (6, 12, 20)]
        figure = comparison.comparison(results)
        self.assertIn("12 mm", [text.get_text() for text in figure.axes[1].texts])
        self.expect_layout(figure)


if __name__ == "__main__":
    unittest.main()
