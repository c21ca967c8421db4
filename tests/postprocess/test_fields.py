# SPDX-License-Identifier: GPL-3.0-only
"""fields.py and mesh.py on frames of short runs, in a plane and in space."""

import shutil
import unittest

import numpy as np

from pictures import PictureTest, draw
from real_results import real_result, run_once
from strip import MESH_22, MESH_41
import fields
import frames
import mesh
import solid_fields
from sprag.results import NotAResult, read_fields

RADIUS, OFFSET = 56, 45.6  # of model A
LEVER, APPARATUS, SOLID = "lever with frames", "apparatus with frames", "solid with frames"
PARTS = {"lever", "layer", "web", "plate", "cylinder", "leaf"}  # of the apparatus


def scenery(name, x=30, way="forward", part="all"):
    result = real_result(name)
    return fields.Scenery(result, frames.chosen_frame(result, x, way), part)


class ChoiceTest(unittest.TestCase):
    def test_nearest_frame_of_the_direction(self):
        result = real_result(LEVER)
        x, turn = result.table["x"], int(result.table["x"].argmax())
        for asked, way in ((28, "forward"), (28, "backward"), (12, None)):
            row = frames.chosen_frame(result, asked, way).row
            self.assertLessEqual(abs(x[row] - asked), 5)
            if way is not None:
                self.assertEqual(row > turn, way == "backward")
        self.assertEqual(frames.chosen_frame(result).row, result.table["P"].argmax())

    def test_missing_frames_are_told_with_how_to_get_them(self):
        for name, x, words in ((LEVER, 70, ("no frame at x = 70 mm", "forward x = ", "Field interval")), ("model-b", None, ("Output/Fields must not be none",))):
            with self.assertRaises(NotAResult) as caught:
                frames.chosen_frame(real_result(name), x)
            for word in words:
                self.assertIn(word, str(caught.exception))


class PlaceTest(unittest.TestCase):
    def test_everything_stands_where_the_file_says(self):
        """Frames are drawn from lever axes, displacements magnified; the file has the axes of the world."""
        result = real_result(APPARATUS)
        written = frames.chosen_frame(result, 20, "backward")
        drawn = fields.Scenery(result, written, "all")
        now = read_fields(result.folder, written.file)
        part, first = now["part"].round(), now["lever"] == 1
        leaf = first & (part == frames.NUMBERS["leaf"])
        for magnify in (1, 50):
            expected = now["nodes"] + now["displacement"] + (magnify - 1) * now["elastic_displacement"]
            np.testing.assert_allclose(drawn.pose.place(drawn.in_lever_axes(magnify)), expected[first & ~leaf][:, :2], atol=2e-4)
        found = drawn.pose.place(drawn.leaf.nodes + drawn.leaf.displacement, frames.rest_inclination(result))
        np.testing.assert_allclose(found, (now["nodes"] + now["displacement"])[leaf][:, :2], atol=2e-4)
        self.assertEqual({frames.PARTS[number] for number in part[first]}, PARTS)

    def test_magnified_contact_leaves_the_circle_in_view(self):
        window = fields.Window(scenery(LEVER))
        edge = window.circle(np.array([window.centre[0] + window.half]))[0]
        self.assertGreater(window.magnify, 1)
        self.assertLess(window.circle(window.centre[:1])[0] - edge, 0.7 * window.half)

    def test_magnified_contact_still_touches(self):
        window = fields.Window(scenery(LEVER), 20)
        frame = window.scenery.frame
        # A face displaced onto the circle is drawn on the circle.
        xi = np.linspace(window.middle - 1, window.middle + 1, 5)
        face = np.flatnonzero(np.abs(frame.nodes[:, 1] - OFFSET) < 1e-9)[: len(xi)]
        frame.nodes[face, 0] = xi
        frame.displacement[face] = np.column_stack((np.zeros(5), window.surface(xi) - OFFSET))
        np.testing.assert_allclose(window.points()[face], np.column_stack((xi, window.circle(xi))), atol=1e-12)


class SolidTest(unittest.TestCase):
    def test_outer_sides_leave_out_the_bond(self):
        result = real_result(SOLID)
        frame = solid_fields.read_solid_frame(result, frames.chosen_frame(result, 20).file)
        sides = solid_fields.outer_sides(frame.nodes, frame.cells[frame.lever_cells(1)])
        eta = frames.pose(result).in_axes(frame.nodes[:, :2])[:, 1]
        at = {name: np.abs(eta[sides] - OFFSET - depth).max(axis=1) < 1e-4 for name, depth in (("face", 0), ("bond", 1), ("back", 21))}
        self.assertEqual([bool(sides.any()) for sides in at.values()], [True, False, True])

    def test_eye_sees_the_sides_that_face_it(self):
        corners = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)], dtype=float)[[0, 4, 6, 2, 1, 5, 7, 3]]
        sides = corners[np.array(solid_fields.SIDES)]
        view = solid_fields.View((0.3, 0.5, 0.8))
        chosen, brightness = view.seen(sides)
        np.testing.assert_allclose(sorted(map(tuple, sides[chosen].mean(axis=1))), [(0.5, 0.5, 1), (0.5, 1, 0.5), (1, 0.5, 0.5)])
        self.assertTrue(((brightness > 0.6) & (brightness <= 1)).all())
        self.assertTrue((np.diff(sides[chosen].mean(axis=1) @ view.towards) >= 0).all())

    def test_pieces_at_the_contacts_of_a_pair(self):
        result = real_result("solid-pair-a")
        written = frames.chosen_frame(result)
        frame = solid_fields.read_solid_frame(result, written.file)
        first, second = (solid_fields.near_contact(result, frame, written.row, lever) for lever in (1, 2))
        self.assertFalse((first & second).any())
        self.assertEqual(first.sum(), second.sum())
        xi = frames.pose(result).in_axes(frame.nodes[:, :2])[np.unique(frame.cells[first]), 0]
        self.assertLessEqual(np.abs(xi - result.table["s"][written.row]).max(), 10)  # a quarter of the width
        titles = [text.get_text() for text in solid_fields.solid_fields(result).texts]
        self.assertTrue(any("second lever from above" in title for title in titles), titles)


class DrawTest(PictureTest):
    def copied(self, name):
        return shutil.copytree(run_once(name), self.folder / "a")

    def test_picture_shows_pressure_and_circle_at_the_chosen_x(self):
        result = real_result(LEVER)
        figure = fields.fields(result, 20, "backward", magnify=50)
        row = frames.chosen_frame(result, 20, "backward").row
        whole, _, below = figure.axes[:3]
        circle = next(patch for patch in whole.patches if hasattr(patch, "radius"))
        self.assertEqual((circle.center, circle.radius), ((result.table["x"][row], 0.0), RADIUS))
        xi, values = next(line for line in below.lines if line.get_label().startswith("pressure")).get_data()
        self.assertAlmostEqual(xi[values.argmax()], result.table["s"][row], delta=0.5)
        self.assertIn("backward", figure._suptitle.get_text())
        self.assertIn("× 50", whole.get_title(loc="left"))

    def test_every_part_of_the_apparatus(self):
        self.copied(APPARATUS)
        for part in ("plate", "cylinder", "leaf"):
            self.expect_picture(draw("fields.py", self.folder / "a", "--x", "30", "--part", part), f"fields-x30-{part}")

    def test_refusals(self):
        for name, arguments, words in (
            (LEVER, ("--part", "plate"), "there are lever"),
            (LEVER, ("--x", "70"), "forward x = "),
            (SOLID, ("--part", "lever"), "plane"),
        ):
            self.expect_refusal(draw("fields.py", run_once(name), *arguments), words)

    def test_frame_that_cannot_be_read_leaves_the_other_pictures(self):
        folder = self.copied(LEVER)
        for frame in folder.glob("fields-[0-9]*.h5"):
            frame.write_text("half")
        done = draw("plot.py", folder)
        self.assertEqual(done.returncode, 0)
        self.assertIn("fields-", done.stderr)
        self.assertTrue((folder / "forces-over-x.png").is_file())
        self.assertFalse((folder / "fields.png").exists())


class MeshTest(PictureTest):
    def test_parts_and_curves_of_a_file(self):
        path = self.folder / "own.msh"
        for text in (MESH_22, MESH_41):
            path.write_text(text)
            found = mesh.read_msh(path)
            self.assertEqual(found.parts["lever"].shape, (52 * 4, 4, 2))
            np.testing.assert_allclose(found.parts["lever"][0], [[0, OFFSET], [210 / 52, OFFSET], [210 / 52, OFFSET + 5], [0, OFFSET + 5]], rtol=1e-5)
            np.testing.assert_allclose(found.curves["hub"], [[[0, OFFSET + 5 * y], [0, OFFSET + 5 * (y + 1)]] for y in range(4)])
            self.assertEqual(len(found.curves["friction face"]), 52)
        path.write_text(MESH_22.replace("2.2 0 8", "2.2 1 8"))
        with self.assertRaisesRegex(NotAResult, "ASCII"):
            mesh.read_msh(path)

    def test_parts_of_a_run_with_the_cylinder_at_its_turning_point(self):
        found = mesh.read_folder(run_once(APPARATUS))
        self.assertEqual(set(found.parts), PARTS)
        face = found.curves["friction face"]
        np.testing.assert_allclose(face[..., 1], OFFSET, atol=1e-6)
        # At the turning point the crest of the cylinder touches the face but for what bends and yields.
        cylinder = found.parts["cylinder"].reshape(-1, 2)
        crest = cylinder[cylinder[:, 1].argmax()]
        self.assertAlmostEqual(crest[1], OFFSET, delta=0.5)
        self.assertAlmostEqual(crest[0], real_result(APPARATUS).table["s"][real_result(APPARATUS).table["x"].argmax()], delta=0.5)
        with self.assertRaisesRegex(NotAResult, "Output/Fields"):
            mesh.read_folder(run_once("model-b"))

    def test_pictures(self):
        folder = shutil.copytree(run_once(APPARATUS), self.folder / "a")
        (self.folder / "own.msh").write_text(MESH_22)
        done = self.silent(draw("mesh.py", folder, self.folder / "own.msh"))
        self.assertEqual(done.stdout.splitlines(), [str(folder / "mesh.png"), str(self.folder / "own.png")])
