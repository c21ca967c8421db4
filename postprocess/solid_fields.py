# SPDX-License-Identifier: GPL-3.0-only
"""One frame of a run in three dimensions: the deformed lever and its stress, and the contact with the pressure on the face."""

from dataclasses import dataclass

import numpy as np
from matplotlib.collections import PolyCollection

from frames import NUMBERS, chosen_frame, every_cell, number, pose
from sprag.results import WAYS, NotAResult, read_fields
from shades import COLOUR_MAP, RIGID, largest_size, make_mappable, make_norm, rounded
from style import MILLIMETRE, TWO_COLUMNS, plt

# Corners of a hexahedron's sides, seen from outside against the clock.
SIDES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
FROM_ABOVE, FROM_BELOW = (-0.45, 0.5, 0.75), (-0.5, -0.6, 0.65)
PRESSURE_MAP = "magma"


@dataclass
class SolidFrame:
    """Hexahedra of lever and cylinder, and the face, in the axes of the world."""

    nodes: np.ndarray  # at rest [n x 3]
    rigid: np.ndarray  # displacement without the elastic part [n x 3]
    elastic: np.ndarray
    stress: np.ndarray  # von Mises [n]
    part: np.ndarray
    cells: np.ndarray  # [m x 8]
    lever: np.ndarray  # to which a node belongs: 1, of a pair 2, of none 0
    face: np.ndarray  # nodes of the face at rest
    face_rigid: np.ndarray
    face_elastic: np.ndarray
    face_cells: np.ndarray  # [m x 4]
    face_lever: np.ndarray
    pressure: np.ndarray

    def at(self, magnify):
        return self.nodes + self.rigid + magnify * self.elastic

    def face_at(self, magnify):
        return self.face + self.face_rigid + magnify * self.face_elastic

    @property
    def is_lever(self):
        """Returns for each node if it belongs to the lever."""
        return self.lever > 0

    def lever_cells(self, lever):
        return self.lever[self.cells[:, 0]] == lever


def read_solid_frame(result, path):
    now, on_face = (read_fields(result.folder, path, group) for group in ("fields", "face"))
    try:
        elastic, elastic_on_face = now["elastic_displacement"], on_face["elastic_displacement"]
        return SolidFrame(now["nodes"], now["displacement"] - elastic, elastic, now["von_mises_stress"],
                          now["part"].round().astype(int), every_cell(now), now["lever"].round(), on_face["nodes"],
                          on_face["displacement"] - elastic_on_face, elastic_on_face, on_face["cells"].astype(int), on_face["lever"].round(),
                          on_face["pressure"])  # fmt: skip
    except (KeyError, ValueError) as error:
        raise NotAResult(f"{path}: cannot be read as fields of this version of sprag ({error})") from error


class View:
    """Parallel light from a direction, up as far as can be."""

    def __init__(self, towards):
        self.towards = np.array(towards) / np.linalg.norm(towards)
        right = np.cross((0, 1, 0), self.towards)
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.towards, self.right)

    def __call__(self, points):
        return np.stack((points @ self.right, points @ self.up), axis=-1)

    def seen(self, polygons):
        """Which of them face the eye, the farthest first, and how bright they are."""
        normals = np.cross(polygons[:, 2] - polygons[:, 0], polygons[:, 3] - polygons[:, 1])
        size = np.linalg.norm(normals, axis=1)
        cosine = normals @ self.towards / np.where(size > 0, size, 1)
        order = np.argsort(polygons.mean(axis=1) @ self.towards)
        chosen = order[cosine[order] > 1e-6]
        return chosen, 0.6 + 0.4 * cosine[chosen]


def outer_sides(nodes, cells):
    """Sides that no two cells share, wherever their nodes are one place [sides x 4]."""
    sides = cells[:, SIDES].reshape(-1, 4)
    places = np.unique(np.round(nodes, 6) + 0.0, axis=0, return_inverse=True)[1].reshape(-1)
    keys = np.sort(places[sides], axis=1)
    _, index, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return sides[index[counts == 1]]


def draw_sides(axes, view, points, sides, colours, zorder=1):
    """Polygons in their colours [sides x 4], shaded by how they face the eye."""
    chosen, brightness = view.seen(points[sides])
    shaded = colours[chosen].copy()
    shaded[:, :3] *= brightness[:, None]
    style = {"linewidth": 0.5, "rasterized": True, "zorder": zorder}
    axes.add_collection(PolyCollection(view(points[sides[chosen]]), facecolor=shaded, edgecolor=shaded, **style))


def stress_colours(frame, sides, norm):
    colours = plt.get_cmap(COLOUR_MAP)(norm(frame.stress[sides].mean(axis=1)))
    colours[frame.part[sides[:, 0]] == NUMBERS["hub"]] = plt.matplotlib.colors.to_rgba(RIGID)
    return colours


def grey(sides, shade="0.94"):
    return np.tile(plt.matplotlib.colors.to_rgba(shade), (len(sides), 1))


def draw_lever(axes, frame, view, magnify, norm):
    """From the lowest on: of a pair the second lever, the cylinder, the first."""
    points = frame.at(magnify)
    for order, lever in enumerate((2, 0, 1)):
        sides = outer_sides(frame.nodes, frame.cells[frame.lever_cells(lever)])
        colours = grey(sides) if lever == 0 else stress_colours(frame, sides, norm)
        draw_sides(axes, view, points, sides, colours, zorder=order)


def draw_contact(axes, frame, lever, magnify, norm, pressure_norm, chosen):
    """Draws a piece of a lever as the cylinder sees it, with the pressure on its face. Returns the length of the arrows [mm]."""
    view = View(FROM_BELOW if lever == 1 else FROM_ABOVE)
    points, face = frame.at(magnify), frame.face_at(magnify)
    sides = outer_sides(frame.nodes, frame.cells[chosen])
    draw_sides(axes, view, points, sides, stress_colours(frame, sides, norm), zorder=1)
    face_cells = frame.face_cells[frame.face_lever[frame.face_cells[:, 0]] == lever]
    pressed = face_cells[(frame.pressure[face_cells] > 0).any(axis=1)]
    colours = plt.get_cmap(PRESSURE_MAP)(pressure_norm(frame.pressure[pressed].mean(axis=1)))
    style = {"linewidth": 0.3, "rasterized": True, "zorder": 2}
    axes.add_collection(PolyCollection(view(face[pressed]), facecolor=colours, edgecolor=colours, **style))
    return draw_axes(axes, view)


def draw_axes(axes, view):
    """Arrows along x, y and z beside what is drawn. Returns their length [mm]."""
    low, high = axes.dataLim.min, axes.dataLim.max
    length = rounded(0.25 * max(high - low))
    start = low - (1.5 * length, 0)
    for name, direction in zip("xyz", np.eye(3)):
        end = start + view(length * direction)
        axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "linewidth": 0.8, "facecolor": "black", "mutation_scale": 6, "shrinkA": 0, "shrinkB": 0}, zorder=5)
        axes.annotate(f"${name}$", start + 1.25 * view(length * direction), ha="center", va="center", fontsize=7, zorder=5)
    room = 0.05 * max(high - low)
    axes.set_xlim(start[0] - room, high[0] + room)
    axes.set_ylim(low[1] - length - room, high[1] + room)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return length


def automatic_magnification(result, frame, row):
    """Draws displacements of a twentieth of the lever's length, unless the layer would be turned inside out."""
    span = np.ptp(frame.nodes[frame.is_lever, 0])
    dent = result.table["indentation"][row]
    sizes = [(0.05 * span, largest_size(frame.elastic)), (0.8 * number(result, "Friction layer", "Thickness", 0.0), dent)]
    return rounded(min((drawn / size for drawn, size in sizes if drawn > 0 and size > 0), default=1.0))


def near_contact(result, frame, row, lever):
    """Cells of a lever about its contact. The second of a pair is the first's mirror image at rest."""
    half = 0.25 * number(result, "Lever", "Width")
    xi = pose(result).in_axes(frame.nodes[:, :2] * ((1, 1) if lever == 1 else (1, -1)))[:, 0]
    away = np.abs(xi - result.table["s" if lever == 1 else "s_2"][row])
    return frame.lever_cells(lever) & (away[frame.cells].max(axis=1) < half)


def solid_fields(result, x=None, way=None, magnify=None):
    """The frame nearest to x, that of the largest P where none is asked for. Throws NotAResult where there is none near."""
    written = chosen_frame(result, x, way)
    frame = read_solid_frame(result, written.file)
    magnify = magnify or automatic_magnification(result, frame, written.row)
    levers = (1, 2) if (frame.lever == 2).any() else (1,)
    chosen = [near_contact(result, frame, written.row, lever) for lever in levers]
    elastic = frame.is_lever & (frame.part != NUMBERS["hub"])
    near = np.unique(frame.cells[np.any(chosen, axis=0)])
    norms = [make_norm([frame.stress[elastic]]), make_norm([frame.stress[near]])]
    pressure_norm = plt.Normalize(0, frame.pressure.max(initial=0) or 1)
    figure = plt.figure(figsize=(TWO_COLUMNS, 92 * MILLIMETRE), constrained_layout=False)
    whole, above = figure.add_axes((0.01, 0.19, 0.56, 0.7)), View(FROM_ABOVE)
    draw_lever(whole, frame, above, magnify, norms[0])
    length = draw_axes(whole, above)
    titles = ("the contact from below",) if len(levers) == 1 else ("first lever from below", "second lever from above")
    tops = [0.91 - 0.37 * index for index in range(len(levers))]
    for lever, cells, top, letter, title in zip(levers, chosen, tops, "bc", titles):
        height = 0.7 if len(levers) == 1 else 0.31
        axes = figure.add_axes((0.6, top - 0.02 - height, 0.39, height))
        arrows = draw_contact(axes, frame, lever, magnify, norms[1], pressure_norm, cells)
        figure.text(0.6, top, f"({letter}) {title}; arrows: {arrows:g} mm", fontsize=8)
    pressure = plt.cm.ScalarMappable(pressure_norm, PRESSURE_MAP)
    bars = ((0.09, "von Mises", make_mappable(norms[0]), "max"), (0.6, "von Mises", make_mappable(norms[1]), "max"), (0.82, "pressure", pressure, "neither"))
    for left, name, mappable, extend in bars:
        bar = figure.add_axes((left, 0.13, 0.4 if left < 0.5 else 0.16, 0.025))
        figure.colorbar(mappable, cax=bar, orientation="horizontal", label=f"{name} [MPa]", extend=extend)
    figure.text(0.02, 0.91, f"(a) {'lever' if len(levers) == 1 else 'levers'} and cylinder from above; arrows: {length:g} mm", fontsize=8)
    figure.suptitle(caption(result, written, magnify), fontsize=8)
    return figure


def caption(result, written, magnify):
    way = {sign: name for name, sign in WAYS.items()}[written.way]
    force = result.table["P"][written.row]
    above = "" if magnify == 1 else f"; elastic displacement × {magnify:g}"
    return f"{result.name}: $x$ = {written.x:.4g} mm {way}, $P$ = {force:.4g} N{above}"
