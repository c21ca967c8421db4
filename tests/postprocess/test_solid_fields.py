# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of fields in three dimensions, on a small box of the shape FieldFrames writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import frames  # noqa: E402
import solid_fields  # noqa: E402
from sprag.results import read_result  # noqa: E402
from test_plot import finish, new_file, put  # noqa: E402

RADIUS, OFFSET, DISTANCE, WIDTH = 20.0, 15.0, 100.0, 12.0
ALONG, ACROSS, ASIDE = np.linspace(0, 90, 31), np.array((OFFSET, OFFSET + 2, OFFSET + 12)), np.linspace(-6, 6, 5)
PARAMETERS = f"""subsection Analysis
  set Type = quasi-static
end
subsection Friction layer
  set Thickness = 2
end
subsection Geometry
  set Cylinder radius = {RADIUS}
  set Interface offset = {OFFSET}
  set Pivot distance = {DISTANCE}
  set Pivot height = 0
end
subsection Lever
  set Width = {WIDTH}
end
subsection Output
  set Field interval = 10
  set Fields = interval
end
"""


def box(lengths):
    """Nodes and hexahedra of a grid, the bond between layer and lever left out."""
    shape = [len(values) for values in lengths]
    nodes = np.stack(np.meshgrid(*lengths, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(np.prod(shape)).reshape(shape)
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [number[i : shape[0] - 1 + i, j : shape[1] - 1 + j, k : shape[2] - 1 + k].ravel() for i, j, k in corners]
    return nodes, np.stack(cells, axis=-1)


def bent(nodes):
    """Elastic displacement of the lever, in its axes."""
    return np.stack((0 * nodes[:, 0], 1e-6 * nodes[:, 0] ** 2, 0 * nodes[:, 0]), axis=-1)


class Lever:
    """Layer and lever with nodes of their own, as they are at rest and at theta."""

    def __init__(self):
        layer, metal = box((ALONG, ACROSS[:2], ASIDE)), box((ALONG, ACROSS[1:], ASIDE))
        self.nodes = np.concatenate((layer[0], metal[0]))
        # Lever axes are left-handed in the world.
        self.cells = np.concatenate((layer[1], metal[1] + len(layer[0])))[:, (0, 3, 2, 1, 4, 7, 6, 5)]
        self.part = np.concatenate((np.full(len(layer[0]), 2), np.full(len(metal[0]), 1)))
        self.part[self.nodes[:, 0] < 10] = frames.NUMBERS["hub"]


def place(nodes, theta):
    along, across = np.array((-np.cos(theta), np.sin(theta), 0)), np.array((np.sin(theta), np.cos(theta), 0))
    return (DISTANCE, 0, 0) + nodes[:, :1] * along + nodes[:, 1:2] * across + nodes[:, 2:] * (0, 0, 1)


def touching(x):
    return np.arcsin((RADIUS - OFFSET) / (DISTANCE - x))


def write(path, groups):
    with h5py.File(path, "w") as file:
        for group, datasets in groups.items():
            for name, values in datasets.items():
                file[f"{group}/{name}"] = values


def on_levers(values, number, image=lambda values: values):
    """Values of a lever and, of a pair, of its mirror image."""
    return values if number == 1 else np.concatenate((values, image(values)))


def mirrored(vectors):
    return vectors * (1, -1, 1)


def make_run(folder, x=(20.0, 30.0), number=1):
    file = new_file(folder)
    del file["parameters"]
    file["parameters"] = PARAMETERS
    x = np.array(x)
    table = file.create_group("table")
    s = np.sqrt((DISTANCE - x) ** 2 - (RADIUS - OFFSET) ** 2)
    columns = {"time": x / 10, "x": x, "P": x / 2, "s": s, "theta": touching(x), "indentation": 0 * x + 0.01, "contact_width": 0 * x + 2,
               "penetration": 0 * x + 1e-5, "Q": x / 3, "centre_across": 0 * x}  # fmt: skip
    if number == 2:
        columns |= {name + "_2": columns[name] for name in ("s", "P", "theta")}
    for name, values in columns.items():
        put(table, name, values, "1")
    lever = Lever()
    xi, zeta = (values.ravel() for values in np.meshgrid(np.linspace(1, 89, 177), np.linspace(-5.5, 5.5, 9)))
    pressure = np.maximum(0, 1 - (xi - s[:, None]) ** 2) * (1 + 0.1 * zeta)
    group = file.create_group("face")
    for name, values in {"xi": xi, "zeta": zeta, "weight": 0 * xi + 0.5, "time": x / 10, "x": x, "pressure": pressure, "traction": pressure, "traction_across": 0 * pressure}.items():
        put(group, name, values, "1")
    finish(file)
    rest, on_face = place(lever.nodes, touching(0)), np.column_stack((xi, 0 * xi + OFFSET, zeta))
    point = np.arange(len(xi)).reshape(9, -1)
    quads = np.stack((point[:-1, :-1], point[:-1, 1:], point[1:, 1:], point[1:, :-1]), axis=-1).reshape(-1, 4)
    lever_numbers = lambda nodes: np.repeat(np.arange(1.0, number + 1), len(nodes))  # noqa: E731
    write(folder / "fields-mesh.h5", {
        "fields": {"nodes": on_levers(rest, number, mirrored),
                   "cells": on_levers(lever.cells, number, lambda cells: len(rest) + cells[:, (0, 3, 2, 1, 4, 7, 6, 5)]),
                   "part": on_levers(lever.part.astype("f4"), number), "lever": lever_numbers(rest)},
        "face": {"nodes": on_levers(place(on_face, touching(0)), number, mirrored),
                 "cells": on_levers(quads, number, lambda cells: len(xi) + cells), "lever": lever_numbers(xi)},
    })  # fmt: skip
    index = ""
    for row, theta in enumerate(touching(x)):
        groups = {}
        for name, nodes in (("fields", lever.nodes), ("face", on_face)):
            elastic = place(bent(nodes), theta) - (DISTANCE, 0, 0)
            whole = place(nodes, theta) + elastic - place(nodes, touching(0))
            groups[name] = {"displacement": on_levers(whole, number, mirrored), "elastic_displacement": on_levers(elastic, number, mirrored)}
        groups["fields"]["von_mises_stress"] = on_levers(90 - lever.nodes[:, 0], number)
        groups["face"]["pressure"] = on_levers(pressure[row], number)
        write(folder / f"fields-{row:04}.h5", groups)
        index += f'<Time Value="{x[row] / 10:.17g}"/> <DataItem>fields-{row:04}.h5:/fields/displacement</DataItem>\n'
    (folder / "fields.xdmf").write_text(index)
    return read_result(folder)


class SolidFieldsTest(PictureTest):
    def frame(self, x):
        result = make_run(self.folder / "a")
        return result, solid_fields.read_solid_frame(result, frames.chosen_frame(result, x).file)

    def test_frame_stands_where_the_lever_does_and_bends_as_many_times(self):
        _, frame = self.frame(20)
        lever = Lever()
        for magnify in (0, 1, 50):
            expected = place(lever.nodes + magnify * bent(lever.nodes), touching(20))
            np.testing.assert_allclose(frame.at(magnify), expected, atol=1e-9)

    def test_outer_sides_leave_out_the_bond(self):
        _, frame = self.frame(20)
        sides = solid_fields.outer_sides(frame.nodes, frame.cells)
        n, m, k = len(ALONG) - 1, len(ACROSS) - 1, len(ASIDE) - 1
        self.assertEqual(len(sides), 2 * (n * m + n * k + m * k))

    def test_eye_sees_the_sides_that_face_it(self):
        _, frame = self.frame(20)
        points = frame.at(1)
        sides = solid_fields.outer_sides(frame.nodes, frame.cells)
        for towards, count in (((0, 1, 1e-3), 30 * 4 + 30 * 2 + 2 * 4), (solid_fields.FROM_BELOW, 30 * 4 + 30 * 2 + 2 * 4)):
            view = solid_fields.View(towards)
            chosen, brightness = view.seen(points[sides])
            self.assertEqual(len(chosen), count)
            self.assertTrue(((brightness > 0.6) & (brightness <= 1)).all())
            depth = points[sides[chosen]].mean(axis=1) @ view.towards
            self.assertTrue((np.diff(depth) >= 0).all())
        below = points[sides[solid_fields.View((0, -1, 0.1)).seen(points[sides])[0]]]
        self.assertLess(below.mean(axis=1)[:, 1].min(), RADIUS + 1)

    def test_piece_at_the_contact_is_about_it(self):
        result, frame = self.frame(30)
        chosen = solid_fields.near_contact(result, frame, 1, 1)
        xi = Lever().nodes[np.unique(frame.cells[chosen]), 0]
        self.assertLessEqual(np.abs(xi - result.table["s"][1]).max(), 0.25 * WIDTH)
        self.assertTrue(chosen.any())

    def test_pieces_of_a_pair_mirror_each_other(self):
        result = make_run(self.folder / "pair", number=2)
        frame = solid_fields.read_solid_frame(result, frames.chosen_frame(result, 30).file)
        first, second = (solid_fields.near_contact(result, frame, 1, lever) for lever in (1, 2))
        np.testing.assert_array_equal(first[: len(first) // 2], second[len(first) // 2 :])
        self.assertFalse((first & second).any())
        self.assertTrue(first.any())
        titles = [text.get_text() for text in solid_fields.solid_fields(result, 30).texts]
        self.assertTrue(any("second lever from above" in title for title in titles), titles)

    def test_picture_tells_place_and_exaggeration(self):
        result, _ = self.frame(20)
        title = solid_fields.solid_fields(result, 20, None, 50)._suptitle.get_text()
        self.assertIn("$x$ = 20 mm forward", title)
        self.assertIn("× 50", title)

    def test_scripts_draw_it(self):
        make_run(self.folder / "a")
        self.expect_picture(draw("fields.py", self.folder / "a", "--x", "20"), "fields-x20")
        self.expect_picture(draw("plot.py", self.folder / "a"), "fields")
        self.expect_refusal(draw("fields.py", self.folder / "a", "--part", "lever"), "--part", "plane")


if __name__ == "__main__":
    unittest.main()
