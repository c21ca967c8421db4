# SPDX-License-Identifier: GPL-3.0-only
"""mesh.py on small meshes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import mesh  # noqa: E402
import test_fields  # noqa: E402
from sprag.results import NotAResult  # noqa: E402

NAMES = """$PhysicalNames
4
1 1 "sensor plate"
1 2 "joint"
2 3 "plate"
2 4 "lever"
$EndPhysicalNames
"""

# Two quadrilaterals side by side, a plate and a lever, with the plate's lower side and the lever's right one named.
VERSION_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
""" + NAMES + """$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
4
1 1 2 1 1 1 2
2 1 2 2 2 3 6
3 3 2 3 1 1 2 5 4
4 3 2 4 2 2 3 6 5
$EndElements
"""

VERSION_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
""" + NAMES + """$Entities
0 2 2 0
1 0 0 0 1 0 0 1 1 0
2 2 0 0 2 1 0 1 2 0
1 0 0 0 1 1 0 1 3 0
2 1 0 0 2 1 0 1 4 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
4 4 1 4
1 1 1 1
1 1 2
1 2 1 1
2 3 6
2 1 3 1
3 1 2 5 4
2 2 3 1
4 2 3 6 5
$EndElements
"""


class MeshTest(PictureTest):
    def test_parts_and_curves_of_a_file(self):
        for text in (VERSION_2, VERSION_4):
            path = self.folder / "own.msh"
            path.write_text(text)
            found = mesh.read_msh(path)
            self.assertEqual(found.parts["plate"].tolist(), [[[0, 0], [1, 0], [1, 1], [0, 1]]])
            self.assertEqual(found.parts["lever"].tolist(), [[[1, 0], [2, 0], [2, 1], [1, 1]]])
            self.assertEqual(found.curves["sensor plate"].tolist(), [[[0, 0], [1, 0]]])
            self.assertEqual(found.curves["joint"].tolist(), [[[2, 0], [2, 1]]])
            self.assertEqual(tuple(found.look), (2, 0.5))

    def test_parts_of_a_run_with_the_cylinder_at_its_turning_point(self):
        test_fields.make_run(self.folder / "a", test_fields.apparatus_blocks() + test_fields.leaf_blocks())
        found = mesh.read_folder(self.folder / "a")
        self.assertEqual(sorted(found.parts), ["cylinder", "hub", "layer", "leaf", "lever", "plate", "web"])
        self.assertEqual([len(found.parts[name]) for name in ("web", "layer", "leaf")], [42 * 3, 59, 20])
        face = found.curves["friction face"]
        self.assertEqual((face[..., 0].min(), face[..., 0].max()), (30, 95))
        self.assertTrue((face[..., 1] == test_fields.OFFSET).all())
        self.assertAlmostEqual(found.look[0], found.parts["cylinder"][..., 0].mean(), 6)
        # At the turning point x = 40 the crest of the cylinder touches the face.
        cylinder = found.parts["cylinder"].reshape(-1, 2)
        crest = cylinder[cylinder[:, 1].argmax()]
        self.assertAlmostEqual(crest[1], test_fields.OFFSET, 7)
        away = test_fields.DISTANCE + test_fields.SPRUNG - 40
        theta = test_fields.touching(40.0)
        self.assertAlmostEqual(crest[0], away * np.cos(theta) - test_fields.HEIGHT * np.sin(theta), 7)

    def test_pictures(self):
        test_fields.make_run(self.folder / "a", test_fields.apparatus_blocks())
        (self.folder / "own.msh").write_text(VERSION_2)
        done = draw("mesh.py", self.folder / "a", self.folder / "own.msh")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.splitlines(), [str(self.folder / "a" / "mesh.png"), str(self.folder / "own.png")])

    def test_refusals(self):
        test_fields.make_run(self.folder / "a", test_fields.lever_blocks(), ())
        with self.assertRaisesRegex(NotAResult, "Output/Fields"):
            mesh.read_folder(self.folder / "a")
        path = self.folder / "own.msh"
        path.write_text(VERSION_2.replace("2.2 0 8", "2.2 1 8"))
        with self.assertRaisesRegex(NotAResult, "ASCII"):
            mesh.read_msh(path)


if __name__ == "__main__":
    unittest.main()
