# SPDX-License-Identifier: GPL-3.0-only
"""fields.py and mesh.py on small frames of the shape FieldFrames writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import fields  # noqa: E402
import frames  # noqa: E402
from sprag.results import NotAResult, read_result  # noqa: E402
from test_plot import finish, new_file, put  # noqa: E402

NUMBERS = {name: number for number, name in frames.PARTS.items()}
RADIUS, OFFSET, DISTANCE, HEIGHT, THICKNESS = 20.0, 15.0, 100.0, 2.0, 1.0
SPRUNG = 0.75  # of the pivot frame


def block(part, along, across, bend=None):
    """Cells of degree 2 between coordinates, bent by a mapping: nodes [cells x 9 x 2] and their part."""
    a, b = np.meshgrid(np.linspace(0, 1, 3), np.linspace(0, 1, 3))
    cells = [
        np.column_stack((x0 + (x1 - x0) * a.ravel(), y0 + (y1 - y0) * b.ravel()))
        for x0, x1 in zip(along[:-1], along[1:])
        for y0, y1 in zip(across[:-1], across[1:])
    ]
    nodes = np.array(cells)
    return (bend(nodes) if bend else nodes), part


def around_centre(points):
    """(angle from +eta, distance) -> cylinder."""
    return np.stack((points[..., 1] * np.sin(points[..., 0]), points[..., 1] * np.cos(points[..., 0])), axis=-1)


def lever_blocks():
    """A bar on a rigid hub, faced with a layer."""
    along = np.linspace(10, 95, 43)
    return [
        block("layer", along, (OFFSET, OFFSET + THICKNESS)),
        block("lever", along, np.linspace(OFFSET + THICKNESS, OFFSET + 11, 4)),
        block("hub", (0.0, 10.0), np.linspace(0, OFFSET + 11, 5)),
    ]


def apparatus_blocks():
    """Plate on sensors, lever with a web, elastic cylinder."""
    along = np.linspace(10, 95, 43)
    return [
        block("layer", np.linspace(30, 95, 60), (OFFSET, OFFSET + THICKNESS)),
        block("plate", np.linspace(30, 95, 60), np.linspace(OFFSET + THICKNESS, OFFSET + 5, 3)),
        block("lever", along, (OFFSET + 8, OFFSET + 10)),
        block("web", along, np.linspace(OFFSET + 10, OFFSET + 16, 4)),
        block("lever", along, (OFFSET + 16, OFFSET + 18)),
        block("hub", (0.0, 10.0), np.linspace(0, OFFSET + 18, 5)),
        block("cylinder", np.linspace(-np.pi, np.pi, 81), np.linspace(10, RADIUS, 6), around_centre),
    ]


def leaf_blocks():
    return [block("leaf", np.linspace(-60, 0, 21), (-0.7, 0.7))]


def displace(nodes, part):
    """Bending of what is not rigid, and a dent of the layer."""
    if part in ("hub", "cylinder"):
        return np.zeros_like(nodes)
    xi, eta = nodes[..., 0], nodes[..., 1]
    across = 1e-6 * xi**2 + (2e-2 * np.exp(-((xi - 60) ** 2)) * (OFFSET + THICKNESS - eta) if part == "layer" else 0)
    return np.stack((1e-4 * xi, across), axis=-1)


def axes_at(theta):
    return np.array(((-np.cos(theta), np.sin(theta)), (np.sin(theta), np.cos(theta))))


def write_group(path, **datasets):
    with h5py.File(path, "w") as file:
        group = file.create_group("fields")
        for name, values in datasets.items():
            group[name] = values


def in_space(vectors):
    return np.column_stack((vectors, np.zeros(len(vectors))))


def write_frames(folder, rows, blocks):
    """In the axes of the world, as sprag does: a lever's mesh where it is at rest, its displacement from there."""
    nodes = np.concatenate([cells.reshape(-1, 2) for cells, _ in blocks])
    elastic = np.concatenate([displace(cells, part).reshape(-1, 2) for cells, part in blocks])
    part = np.concatenate([np.full(len(cells) * 9, NUMBERS[name]) for cells, name in blocks])
    first = np.arange(0, len(nodes), 9)[:, None, None]
    quads = (first + np.array([(0, 3, 4, 1), (1, 4, 5, 2), (3, 6, 7, 4), (4, 7, 8, 5)])).reshape(-1, 4)
    rigid = part[quads[:, 0]] == NUMBERS["hub"]
    at_centre = (part == NUMBERS["cylinder"])[:, None]
    resting = touching(SPRUNG)

    def place(points, x, theta, moved):
        return points @ axes_at(theta) + np.where(at_centre, (x, 0.0), (DISTANCE + moved, HEIGHT))

    rest = place(nodes, 0.0, resting, 0.0)
    write_group(folder / "fields-mesh.h5", nodes=in_space(rest), cells=quads[~rigid].astype(np.uint32), rigid_cells=quads[rigid].astype(np.uint32), part=part.astype("f4"),
                lever=np.ones(len(nodes)))  # fmt: skip
    index = ""
    for number, row in enumerate(rows):
        theta = touching(X[row])
        file = f"fields-{number:04}.h5"
        now = place(nodes + elastic, X[row], theta, SPRUNG)
        write_group(
            folder / file,
            displacement=in_space(now - rest),
            elastic_displacement=in_space(elastic @ axes_at(theta)),
            von_mises_stress=np.where(part == NUMBERS["hub"], 0, 1e-2 * part * (1 + np.abs(np.sin(nodes[:, 0] / 20)))),
        )
        index += f'<Grid>\n<Time Value="{TIMES[row]:.17g}"/>\n<DataItem>fields-mesh.h5:/fields/nodes</DataItem>\n<DataItem>{file}:/fields/displacement</DataItem>\n</Grid>\n'
    (folder / "fields.xdmf").write_text(index)


PARAMETERS = f"""subsection Analysis
  set Type = quasi-static
end
subsection Cylinder
  set Inner radius = 10
end
subsection Friction layer
  set Thickness = {THICKNESS}
end
subsection Friction plate
  set Guide = 60
  set Sensors = 40, 50, 70, 85
  set Spacer = 3
end
subsection Geometry
  set Cylinder radius = {RADIUS}
  set Interface offset = {OFFSET}
  set Pivot distance = {DISTANCE}
  set Pivot height = {HEIGHT}
end
subsection Mesh
  set Degree = 2
end
subsection Output
  set Field interval = 10
  set Fields = FIELDS
end
subsection Rotational spring
  set Type = leaf
end
"""


def touching(x):
    """theta at which the face touches the cylinder (eq. 9)."""
    distance = DISTANCE + SPRUNG - x
    return np.arcsin((RADIUS - OFFSET) / np.hypot(distance, HEIGHT)) - np.arctan2(HEIGHT, distance)


X = np.concatenate((np.arange(0.0, 41), np.arange(39.0, -1, -1)))
TIMES = np.arange(len(X)) / 100
WRITTEN = (10, 20, 30, 40, 50, 60)  # rows: x = 10 .. 40 forward, 30 and 20 backward


def make_run(folder, blocks, written=WRITTEN, field_frames="interval"):
    file = new_file(folder)
    del file["parameters"]
    file["parameters"] = PARAMETERS.replace("FIELDS", field_frames)
    theta = touching(X)
    away = DISTANCE + SPRUNG - X
    s = away * np.cos(theta) - HEIGHT * np.sin(theta)
    table = file.create_group("table")
    for name, values, unit in (
        ("time", TIMES, "s"),
        ("x", X, "mm"),
        ("theta", theta, "rad"),
        ("s", s, "mm"),
        ("P", X / 10, "N"),
        ("Q", X / 12, "N"),
        ("centre_offset", np.zeros(len(X)), "mm"),
        ("contact_width", np.full(len(X), 2.0), "mm"),
        ("penetration", np.full(len(X), 1e-5), "mm"),
        ("indentation", np.full(len(X), 2e-2), "mm"),
        ("support_displacement", np.full(len(X), SPRUNG), "mm"),
    ):
        put(table, name, values, unit)
    xi = np.linspace(10, 95, 851)
    pressure = np.maximum(0, 1 - (xi - s[:, None]) ** 2)
    face = file.create_group("face")
    for name, values, unit in (
        ("xi", xi, "mm"),
        ("weight", np.ones_like(xi), "mm^2"),
        ("time", TIMES, "s"),
        ("x", X, "mm"),
        ("pressure", pressure, "MPa"),
        ("traction", 0.7 * pressure, "MPa"),
    ):
        put(face, name, values, unit)
    finish(file)
    if written:
        write_frames(folder, written, blocks)
    return read_result(folder)


class FrameTest(PictureTest):
    def refusal(self, *arguments, **options):
        with self.assertRaises(NotAResult) as caught:
            frames.chosen_frame(*arguments, **options)
        return str(caught.exception)


class ChoiceTest(FrameTest):
    def test_nearest_frame_of_the_direction(self):
        result = make_run(self.folder / "a", lever_blocks())
        for x, way, row in ((None, None, 40), (28, "forward", 30), (28, "backward", 50), (12, None, 10), (24, "backward", 60)):
            self.assertEqual(frames.chosen_frame(result, x, way).row, row)

    def test_missing_x_names_those_there_and_how_to_get_more(self):
        text = self.refusal(make_run(self.folder / "a", lever_blocks()), 10, "backward")
        for words in ("no frame at x = 10 mm backward", "forward x = 10, 20, 30, 40 mm", "backward x = 30, 20 mm", "Field interval"):
            self.assertIn(words, text)
        result = make_run(self.folder / "b", lever_blocks(), (40, 80), "turning points")
        self.assertIn("Output/Fields = interval", self.refusal(result, 20))

    def test_run_without_frames(self):
        result = make_run(self.folder / "a", lever_blocks(), ())
        self.assertIn("Output/Fields must not be none", self.refusal(result))


class PlaceTest(FrameTest):
    def scenery(self, blocks, x=30, part="all"):
        result = make_run(self.folder / "a", blocks)
        return fields.Scenery(result, frames.chosen_frame(result, x, "forward"), part)

    def test_lever_turns_about_the_pivot_which_its_support_moves(self):
        scenery = self.scenery(lever_blocks())
        theta = touching(30)
        for magnify in (1, 50):
            points = scenery.pose.place(scenery.in_lever_axes(magnify))
            expected_along = (1 + 1e-4 * magnify) * 95
            tip = np.flatnonzero((scenery.frame.nodes == (95, OFFSET + 11)).all(axis=1))[0]
            expected_across = OFFSET + 11 + magnify * 1e-6 * 95**2
            self.assertAlmostEqual(
                points[tip][0], DISTANCE + SPRUNG - expected_along * np.cos(theta) + expected_across * np.sin(theta), 9
            )
            self.assertAlmostEqual(points[tip][1], HEIGHT + expected_along * np.sin(theta) + expected_across * np.cos(theta), 9)

    def test_undeformed_face_touches_the_cylinder_where_it_stands(self):
        scenery = self.scenery(lever_blocks())
        face = scenery.pose.place(np.column_stack((np.linspace(10, 95, 20001), np.full(20001, OFFSET))))
        self.assertAlmostEqual(np.hypot(face[:, 0] - 30, face[:, 1]).min(), RADIUS, 6)

    def test_elastic_cylinder_is_shifted_to_its_centre(self):
        scenery = self.scenery(apparatus_blocks())
        cylinder = scenery.frame.shown(["cylinder"])
        points = scenery.pose.place(scenery.in_lever_axes(50))[cylinder]
        distance = np.hypot(points[:, 0] - 30, points[:, 1])
        self.assertAlmostEqual(distance.max(), RADIUS, 7)
        self.assertTrue((distance > 10 * np.cos(np.pi / 80) - 1e-7).all())

    def test_leaf_turns_with_the_hub_from_where_it_was_at_rest(self):
        result = make_run(self.folder / "a", lever_blocks() + leaf_blocks())
        scenery = fields.Scenery(result, frames.chosen_frame(result, 20, "forward"), "all")
        turn = touching(20.0) - touching(SPRUNG)
        nodes = scenery.leaf.nodes
        elastic = displace(nodes, "leaf")
        c, s = np.cos(turn), np.sin(turn)
        expected = (nodes + elastic) @ np.array(((c, s), (-s, c))) - nodes
        np.testing.assert_allclose(scenery.leaf.displacement, expected, atol=1e-6)
        self.assertFalse(scenery.frame.shown(["leaf"]).any())

    def test_magnified_contact_leaves_the_circle_in_view(self):
        window = fields.Window(self.scenery(lever_blocks()))
        edge = window.circle(np.array([window.centre[0] + window.half]))[0]
        self.assertGreater(window.magnify, 1)
        self.assertLess(window.circle(window.centre[:1])[0] - edge, 0.7 * window.half)

    def test_magnified_contact_still_touches(self):
        scenery = self.scenery(lever_blocks())
        window = fields.Window(scenery, 20)
        # A face displaced onto the circle is drawn on the circle.
        xi = np.linspace(window.middle - 1, window.middle + 1, 5)
        face = np.flatnonzero(np.abs(scenery.frame.nodes[:, 1] - OFFSET) < 1e-9)[: len(xi)]
        scenery.frame.nodes[face, 0] = xi
        scenery.frame.displacement[face] = np.column_stack((np.zeros(5), window.surface(xi) - OFFSET))
        np.testing.assert_allclose(window.points()[face], np.column_stack((xi, window.circle(xi))), atol=1e-12)

    def test_magnified_contact_of_an_elastic_cylinder_still_touches(self):
        scenery = self.scenery(apparatus_blocks())
        scenery.frame.nodes[0] = (0, RADIUS)  # a node of the layer, onto the cylinder's crest
        crest = np.flatnonzero(scenery.frame.shown(["cylinder"]) & (np.abs(scenery.frame.nodes - (0, RADIUS)).max(axis=1) < 1e-9))[0]
        scenery.frame.displacement[crest] = (0.01, -0.02)
        window = fields.Window(scenery, 20)
        place = window.centre + (0, RADIUS)
        scenery.frame.nodes[0] = (place[0], OFFSET)
        scenery.frame.displacement[0] = (0.01, place[1] - 0.02 - OFFSET)
        points = window.points()
        np.testing.assert_allclose(points[crest], points[0], atol=1e-9)

    def test_borders_are_outlines_of_the_parts(self):
        frame = self.scenery(lever_blocks()).frame
        lines = frame.nodes[frame.borders(["lever"])]
        length = np.linalg.norm(np.diff(lines, axis=1), axis=-1).sum()
        self.assertAlmostEqual(length, 2 * (85 + 10), 9)

    def test_automatic_magnification_does_not_turn_the_layer_inside_out(self):
        scenery = self.scenery(lever_blocks())
        self.assertEqual(fields.automatic_magnification(scenery), 20)  # 0.8 mm over an indentation of 0.02 mm: 40
        scenery.result.table["indentation"][:] = 0
        largest = np.linalg.norm(scenery.frame.displacement, axis=1).max()
        expected = 0.05 * 95 / largest
        self.assertLessEqual(fields.automatic_magnification(scenery), expected)
        self.assertGreater(2.5 * fields.automatic_magnification(scenery), expected)


class DrawTest(PictureTest):
    def test_picture_shows_pressure_and_circle_at_the_chosen_x(self):
        result = make_run(self.folder / "a", lever_blocks())
        figure = fields.fields(result, 20, "backward", magnify=50)
        whole, _, below = figure.axes[:3]
        circle = next(patch for patch in whole.patches if hasattr(patch, "radius"))
        self.assertEqual((circle.center, circle.radius), ((20.0, 0.0), RADIUS))
        pressure = next(line for line in below.lines if line.get_label().startswith("pressure"))
        xi, values = pressure.get_data()
        self.assertAlmostEqual(xi[values.argmax()], result.table["s"][60], delta=0.05)
        self.assertIn("backward", figure._suptitle.get_text())
        self.assertIn("× 50", whole.get_title(loc="left"))

    def test_every_part_of_the_apparatus(self):
        make_run(self.folder / "a", apparatus_blocks() + leaf_blocks())
        for part in ("all", "plate", "cylinder", "leaf"):
            name = "fields-x30" + ("" if part == "all" else f"-{part}")
            done = draw("fields.py", self.folder / "a", "--x", "30", "--part", part)
            self.expect_picture(done, name)

    def test_refusals(self):
        make_run(self.folder / "a", lever_blocks())
        for arguments, words in (
            (("--part", "plate"), "there are lever"),
            (("--x", "70"), "forward x = 10, 20, 30, 40 mm"),
        ):
            done = draw("fields.py", self.folder / "a", *arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)

    def test_plot_draws_a_frame(self):
        make_run(self.folder / "a", lever_blocks())
        self.expect_picture(draw("plot.py", self.folder / "a"), "fields")

    def test_frame_that_cannot_be_read_leaves_the_other_pictures(self):
        make_run(self.folder / "a", lever_blocks())
        (self.folder / "a" / "fields-0003.h5").write_text("half")
        done = draw("plot.py", self.folder / "a")
        self.assertEqual(done.returncode, 0)
        self.assertIn("fields-0003.h5", done.stderr)
        self.assertTrue((self.folder / "a" / "forces-over-x.png").is_file())
        self.assertFalse((self.folder / "a" / "fields.png").exists())


if __name__ == "__main__":
    unittest.main()
