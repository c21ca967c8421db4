# SPDX-License-Identifier: GPL-3.0-only
"""Distances in drawings of the device are those that are meant."""

import os
from functools import lru_cache
from pathlib import Path

import numpy as np

from pictures import SOURCE, PictureTest, draw
import apparatus
import device
import plot
from sprag import program
from sprag.results import NotAResult, read_result
from layout import problems
from style import use_print_style

SCENES = Path(os.environ.get("SPRAG_SOURCE", SOURCE)) / "params"
SPRAG = program.program()
TALL = """subsection Geometry
  set Cylinder radius  = 30
  set Interface offset = 12
  set Pivot distance   = 160
  set Pivot height     = -25
end
subsection Lever
  set Length = 170
end
subsection Drive
  set Stroke = 40
end
"""


@lru_cache
def draw_scene(scene):
    """A device, its drawing and what is wrong with the layout."""
    found = apparatus.make_device(scene, SPRAG, None)
    use_print_style()
    figure = device.drawing(found)
    return found, figure, problems(figure)


class DeviceTest(PictureTest):
    def drawn(self, scene):
        self.device, figure, wrong = draw_scene(scene)
        (self.axes,) = figure.axes
        self.assertEqual(wrong, [])

    def patches(self, gid):
        return [patch for patch in self.axes.patches if patch.get_gid() == gid]

    def line(self, gid):
        return np.transpose(next(line for line in self.axes.lines if line.get_gid() == gid).get_data())

    def said(self, begin):
        """The number behind a name on the page."""
        text = next(text.get_text() for text in self.axes.texts if text.get_text().strip().startswith(begin))
        return float(text.split("=")[1].split("°")[0].split("mm")[0].split("N")[0].replace("\N{MINUS SIGN}", "-"))

    def expect_geometry(self, scene, R, e, l, h, x):
        self.drawn(scene)
        (cylinder,), (pivot,) = self.patches("cylinder"), self.patches("pivot")
        self.assertEqual((cylinder.center, cylinder.radius), ((x, 0.0), R))
        self.assertEqual(tuple(pivot.center), (l, h))
        foot, contact = self.line("face")
        along = (contact - foot) / np.linalg.norm(contact - foot)
        normal = np.array((along[1], -along[0]))
        # The friction face touches the cylinder and is e away from the pivot.
        self.assertAlmostEqual(abs((foot - cylinder.center) @ normal), R, 9)
        self.assertAlmostEqual(np.linalg.norm(contact - cylinder.center), R, 9)
        self.assertAlmostEqual(abs((foot - pivot.center) @ normal), e, 9)
        np.testing.assert_allclose(self.line("contact")[0], contact, atol=1e-9)
        theta = np.arctan2(along[1], -along[0])
        self.assertAlmostEqual((l - x) * np.sin(theta) + h * np.cos(theta), R - e, 9)
        s = (l - x) * np.cos(theta) - h * np.sin(theta)
        self.assertAlmostEqual(np.linalg.norm(contact - foot), s, 9)
        for name, value in (("$R$", R), ("$l$", l), ("$x$", x), ("$s$", s), (r"$\theta$", np.degrees(theta))):
            self.assertAlmostEqual(self.said(name), value, delta=6e-3 * abs(value))
        # The rays of the angles.
        for gid, at in (("axis", x), ("axis at rest", 0)):
            begin, end = self.line(gid)
            angle = np.arctan2(end[1] - begin[1], begin[0] - end[0])
            self.assertAlmostEqual((l - at) * np.sin(angle) + h * np.cos(angle), R - e, 9)
        # The layer as it is meshed lies on the line, its outline is not on the cylinder's side.
        layer = np.concatenate([patch.get_path().vertices for patch in self.patches("layer")])
        self.assertAlmostEqual(((layer - pivot.center) @ normal).min(), e, 5)
        self.assertGreater(np.hypot(*(layer - cylinder.center).T).min(), R - 1e-5)
        return theta, s

    def test_model_a_and_what_the_program_says_of_it(self):
        theta, s = self.expect_geometry(SCENES / "model-a.prm", 56, 45.6, 185.5, 0, 65)
        program.run_scene(SPRAG, SCENES / "closed-form-a.prm", self.folder / "run", {})
        table = read_result(self.folder / "run").table
        row = np.flatnonzero(table["x"] == 65)[0]
        self.assertAlmostEqual(theta, table["theta"][row], 12)
        self.assertAlmostEqual(s, table["s"][row], 9)
        for name in "PFQ":
            self.assertAlmostEqual(self.said(f"${name}$"), table[name][row], delta=6e-3 * table[name][row])
        self.assertAlmostEqual(self.said(r"$\theta_0$"), 3.213955331, delta=5e-3)

    def test_picture_of_a_design_is_the_lever_found(self):
        program.run_scene(SPRAG, SCENES / "design-a.prm", self.folder / "run", {"Design/Judges": "none", "Design/Demands": "damping slope = 0.1 +- 0.001; jamming margin >= 0.5"})
        result = read_result(self.folder / "run")
        (self.axes,) = plot.draw([result])["device"].axes
        found = [float(result.table[f"geometry_{name}"][0]) for name in ("cylinder_radius", "interface_offset", "pivot_distance")]
        for name, value in zip(("$R$", "$e$", "$l$"), found):
            self.assertAlmostEqual(self.said(name), value, delta=6e-4 * value)
        self.assertEqual(self.patches("cylinder")[0].radius, found[0])

    def test_model_b(self):
        self.expect_geometry(SCENES / "model-b.prm", 21.1, 0, 193.9, 0, 65)

    def test_a_pivot_below_the_path_on_a_leaf_spring(self):
        scene = self.folder / "tall.prm"
        scene.write_text(TALL + "subsection Rotational spring\n  set Type = leaf\nend\n")
        theta, _ = self.expect_geometry(scene, 30, 12, 160, -25, 40)
        self.assertEqual(self.said("$h$"), -25)
        leaf = np.concatenate([patch.get_path().vertices for patch in self.patches("leaf")])
        # Clamped in the hub, its end held where it was at rest.
        turned = theta - self.device.geometry(40).theta_0
        self.assertGreater(turned, 0.05)
        end = leaf[np.abs(leaf[:, 0] - leaf[:, 0].max()) < 2].mean(axis=0)
        at_rest = np.array((160, -25)) + 100 * np.array((np.cos(theta - turned), -np.sin(theta - turned)))
        self.assertLess(np.linalg.norm(end - at_rest), 1.5)

    def test_forces_are_a_triangle(self):
        self.drawn(SCENES / "model-a.prm")
        arrows = {text.get_gid(): text for text in self.axes.texts if text.get_gid()}
        vectors = {name: np.array(arrow.xy) - arrow.xyann for name, arrow in arrows.items()}
        geometry, forces = self.device.geometry(65), self.device.forces
        self.assertAlmostEqual(vectors["P"] @ geometry.along, 0, 9)
        self.assertAlmostEqual(vectors["F"] @ geometry.across, 0, 9)
        self.assertLess(vectors["F"] @ geometry.along, 0)
        self.assertAlmostEqual(np.linalg.norm(vectors["F"]) / np.linalg.norm(vectors["P"]), forces.F / forces.P, 9)
        self.assertAlmostEqual(vectors["Q"][0] / np.linalg.norm(vectors["P"]), forces.Q / forces.P, 9)
        self.assertEqual(vectors["Q"][1], 0)

    def test_apparatus(self):
        self.drawn(SCENES / "apparatus-a.prm")
        geometry, offset = self.device.geometry(65), 45.6
        boxes = apparatus.connectors(self.device)
        self.assertEqual([corners[:, 0].mean() for corners, _ in boxes], [105, 135, 165, 195, 150])
        for corners, _ in boxes:
            self.assertAlmostEqual(corners[:, 1].min(), offset + 1 + 8, 6)
            self.assertAlmostEqual(np.ptp(corners[:, 1]), 6, 6)
        names = {text.get_text() for text in self.axes.texts}
        self.assertLessEqual({"friction plate", "force sensor", "guide", "leaf spring", "spring of\nthe support", "cylinder"}, names)
        plate = np.concatenate([patch.get_path().vertices for patch in self.patches("plate")]) - geometry.pivot
        self.assertAlmostEqual((plate @ geometry.across).max(), offset + 9, 5)
        self.assertAlmostEqual((plate @ geometry.along).max(), 205, 5)

    def test_pair_touches_the_cylinder_on_both_sides(self):
        self.drawn(SCENES / "pair-a.prm")
        layers = [patch.get_path().vertices for patch in self.patches("layer")]
        self.assertEqual(len(layers), 2)
        for vertices, side in zip(layers, (1, -1)):
            inner = np.roll(vertices, -1, axis=0), vertices
            distance = distance_to_segments(np.array((65.0, 0.0)), *inner)
            self.assertAlmostEqual(distance, 56, 5)
            self.assertGreater(side * vertices[:, 1].mean(), 0)

    def test_no_contact_there(self):
        found = apparatus.make_device(SCENES / "closed-form-a.prm", SPRAG, 250)
        self.assertIsNone(found.forces)
        with self.assertRaisesRegex(NotAResult, "no contact"):
            device.drawing(found, 250)

    def test_script_on_a_result_and_on_mistakes(self):
        program.run_scene(SPRAG, SCENES / "model-a.prm", self.folder / "a", {"Mesh/Face size": 2})
        done = draw("device.py", self.folder / "a", "--x", "30", "--format", "svg", "--sprag", SPRAG)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", f"{self.folder / 'a' / 'device.svg'}\n"))
        self.expect_refusal(draw("device.py", self.folder / "no.prm"), "no.prm: no such file")
        (self.folder / "wrong.prm").write_text("subsection Geometry\n  set Cylinder radius = -1\nend\n")
        done = draw("device.py", self.folder / "wrong.prm", "--sprag", SPRAG)
        self.assertEqual(done.returncode, 2)
        self.assertIn("wrong.prm:2: Geometry/Cylinder radius = -1", done.stderr)


def distance_to_segments(point, ends, begins):
    along = ends - begins
    share = np.clip(((point - begins) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-30), 0, 1)
    return np.hypot(*(begins + share[:, None] * along - point).T).min()
