#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws one frame of a run's fields: the apparatus with the deformed mesh and its stress, the contact, the pressure there."""

import sys

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection, TriMesh
from matplotlib.tri import Triangulation

from arguments import add_folders, add_output, make_parser, picture_paths, save, script
from frames import PARTS, WAYS, any_of, chosen_frame, number, pose, read_frame, rest_inclination
from sprag.results import NotAResult, read_result
from shades import COLOUR_MAP, RIGID, is_logarithmic, largest_size, make_mappable, make_norm, rounded
from solid_fields import solid_fields
from style import COLOURS, MILLIMETRE, TWO_COLUMNS, plt, use_print_style
from surface import is_solid

# The parts that each choice of --part shows in colour.
CHOICES = {
    "all": ("lever", "layer", "web", "plate", "cylinder", "leaf"),
    "lever": ("lever", "layer", "web"),
    "plate": ("plate", "layer"),
    "cylinder": ("cylinder",),
    "leaf": ("leaf",),
}
PANEL = 136 * MILLIMETRE  # width of the panels
GRID = {"edgecolor": "white", "linewidth": 0.12, "alpha": 0.5, "zorder": 3}
EDGE = {"edgecolor": "0.3", "linewidth": 0.5}


class Scenery:
    """A result, one of its frames and what the pictures of it share."""

    def __init__(self, result, written, part):
        self.result = result
        self.row = written.row
        self.way = written.way
        self.frame, self.leaf = read_frame(result, written.file, written.row)
        self.pose = pose(result, written.row)
        self.radius = number(result, "Geometry", "Cylinder radius")
        self.offset = number(result, "Geometry", "Interface offset")
        self.part = part
        self.coloured = CHOICES[part]
        self.elastic_cylinder = bool(self.frame.shown(["cylinder"]).any())

    def layer_thickness(self):
        """0 without one."""
        return number(self.result, "Friction layer", "Thickness", 0.0) if self.frame.shown(["layer"]).any() else 0.0

    def column(self, name):
        return self.result.table[name][self.row] if name in self.result.table else np.nan

    def in_lever_axes(self, magnify):
        """Nodes displaced by so many times the elastic displacement; a cylinder's shifted to where it stands."""
        nodes = self.frame.nodes + magnify * self.frame.displacement
        return np.where(self.frame.shown(["cylinder"])[:, None], nodes + self.pose.centre(), nodes)


# The apparatus as a whole


def automatic_magnification(scenery):
    """Draws displacements of a twentieth of the lever's length, unless the layer would be turned inside out."""
    span = np.ptp(scenery.frame.nodes[~scenery.frame.shown(["cylinder"]), 0])
    sizes = [(0.05 * span, largest_size(scenery.frame.displacement)), (0.8 * scenery.layer_thickness(), scenery.column("indentation"))]
    return rounded(min((drawn / size for drawn, size in sizes if drawn > 0 and size > 0), default=1.0))


def draw_apparatus(axes, scenery, magnify):
    """In the table's axes: the lever inclined on its pivot, the cylinder at its x. Returns what a colour bar stands for."""
    frame, place = scenery.frame, scenery.pose.place
    points = place(scenery.in_lever_axes(magnify))
    rest = place(scenery.in_lever_axes(0))
    bodies = [(frame, points)]
    if scenery.leaf is not None:
        leaf = scenery.leaf.nodes + scenery.leaf.displacement  # turns with the hub: as large as it is
        bodies.append((scenery.leaf, place(leaf, rest_inclination(scenery.result))))
    draw_cylinder(axes, scenery)
    norm = make_norm([body.stress[body.shown(scenery.coloured)] for body, _ in bodies], each_by_itself(bodies, scenery))
    for body, where in bodies:
        mappable = draw_stress(axes, body, where, scenery.coloured, norm) or make_mappable(norm)
        add(axes, PolyCollection(where[large_cells(body, np.ptp(points, axis=0).max())], facecolor="none", **GRID))
        add(axes, LineCollection(where[body.borders()], colors="black", linewidths=0.4, zorder=4))
    if magnify > 1:
        add(axes, LineCollection(rest[frame.borders()], colors="0.55", linewidths=0.3, linestyles=":", zorder=1))
    draw_connectors(axes, scenery, points)
    draw_surroundings(axes, scenery)
    set_view(axes, scenery, bodies)
    return mappable


def add(axes, collection):
    """The limits of all panels are set by hand: finding those of a collection, here or for the layout, would cost as much as drawing it."""
    collection.set_in_layout(False)
    return axes.add_collection(collection, autolim=False)


def large_cells(body, span, share=0.005):
    """Outlines of cells whose lines would not hide the colours on a picture of that span."""
    corners = body.nodes[body.outlines]
    return body.outlines[np.ptp(corners, axis=1).min(axis=1) > share * span]


def each_by_itself(bodies, scenery):
    return [body.stress[body.part == name] for body, _ in bodies for name in scenery.coloured if (body.part == name).any()]


def draw_stress(axes, body, points, coloured, norm):
    """Filled colour over the parts named as far as they are seen; the others grey. Returns what a colour bar stands for."""
    pale = body.outlines[~any_of(body.cell_part, coloured)]
    add(axes, PolyCollection(points[pale], facecolor=RIGID, edgecolor=RIGID, linewidth=0.2, zorder=2))
    quads = body.quads[body.shown(coloured)[body.quads[:, 0]]]
    if len(quads) == 0:
        return None
    triangles = np.concatenate((quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]))
    mesh = TriMesh(Triangulation(*points.T, triangles), norm=norm, cmap=COLOUR_MAP, zorder=2, rasterized=True)
    mesh.set_array(body.stress)
    return add(axes, mesh)


def draw_cylinder(axes, scenery):
    where = (scenery.pose.x, 0.0)
    axes.add_patch(plt.Circle(where, scenery.radius, facecolor="0.94", zorder=0.9, **EDGE))  # of a pair half of it is meshed
    core = number(scenery.result, "Cylinder", "Inner radius", 0.0) if scenery.elastic_cylinder else scenery.radius
    axes.add_patch(plt.Circle(where, core, facecolor="0.94", zorder=1, **EDGE))
    axes.plot(*where, "+", color="0.3", markersize=6, zorder=3)


def draw_connectors(axes, scenery, points):
    """Force sensors and guide of a friction plate, from its back to the lever."""
    frame, result = scenery.frame, scenery.result
    if not frame.shown(["plate"]).any() or scenery.part in ("cylinder", "leaf"):
        return
    back = frame.nodes[frame.shown(["plate"]), 1].max()
    front = back + number(result, "Friction plate", "Spacer")
    ends = [nodes_at(frame, ["plate"], back), nodes_at(frame, ["lever"], front)]
    sensors = [float(text) for text in result.parameter("Friction plate", "Sensors").split(",")]
    guide = [number(result, "Friction plate", "Guide")]
    for places, name, colour in ((sensors, "force sensors", COLOURS[1]), (guide, "guide", COLOURS[3])):
        for index, xi in enumerate(places):
            line = [points[nodes[np.abs(frame.nodes[nodes, 0] - xi).argmin()]] for nodes in ends if len(nodes)]
            axes.plot(*np.transpose(line), color=colour, linewidth=2.5, solid_capstyle="butt", zorder=5, label=None if index else name)


def nodes_at(frame, parts, height):
    return np.flatnonzero(frame.shown(parts) & (np.abs(frame.nodes[:, 1] - height) < 1e-4))


def draw_surroundings(axes, scenery):
    """Pivot, the cylinder's path and its direction."""
    pivot, where = scenery.pose.pivot, scenery.pose
    axes.axhline(0.0, color="0.4", linewidth=0.6, linestyle=(0, (8, 2, 1.5, 2)), zorder=0)
    axes.plot(*pivot, "o", color="white", markeredgecolor="black", markersize=5, zorder=6)
    if scenery.part == "all":
        box = {"facecolor": "white", "alpha": 0.7, "linewidth": 0, "pad": 0.8}
        axes.annotate("pivot", pivot, xytext=(0, -8), textcoords="offset points", ha="center", va="top", fontsize=7, zorder=6, bbox=box)
    length = 0.3 * scenery.radius * scenery.way
    axes.annotate("", (where.x + length, 0.0), (where.x, 0.0), arrowprops={"arrowstyle": "-|>", "linewidth": 1}, zorder=5)


def set_view(axes, scenery, bodies):
    """Around what is in colour."""
    names = scenery.coloured if scenery.part != "all" else PARTS.values()
    shown = [points[body.shown(list(names))] for body, points in bodies]
    corners = np.concatenate(shown)
    if scenery.part == "all":
        corners = np.concatenate((corners, [scenery.pose.pivot, (scenery.pose.x - scenery.radius, -scenery.radius)]))
    if len(corners):
        low, high = corners.min(axis=0), corners.max(axis=0)
        room = 0.04 * max(high - low)
        axes.set_xlim(low[0] - room, high[0] + room)
        axes.set_ylim(low[1] - room, high[1] + room)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("$x$ [mm]")
    axes.set_ylabel("$y$ [mm]")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2, handlelength=1, columnspacing=1, borderaxespad=0.2)


# The contact


class Window:
    """Shows the contact in lever axes; displacements across the lever are magnified, less the metal's motion there.

    The cylinder's distance from the undeformed face is magnified as much: faces that touch still do.
    """

    def __init__(self, scenery, magnify=None):
        self.scenery = scenery
        self.centre = scenery.pose.centre()
        place, width = scenery.column("s"), scenery.column("contact_width")
        self.middle = place if np.isfinite(place) else self.centre[0]
        self.half = float(np.clip(max(1.5 * width if width > 0 else 0.0, 2.5 * scenery.layer_thickness()), 0.5, 10.0))
        frame = scenery.frame
        near = (np.abs(frame.nodes[:, 0] - self.middle) < self.half) & ~frame.shown(["cylinder"])
        inside = near & (frame.nodes[:, 1] < scenery.offset + 0.8 * self.half)
        metal = inside & frame.shown(["lever", "plate", "web"])
        carrier = metal if metal.any() else inside
        self.motion = np.zeros(2)  # slope and value of what the magnification leaves alone
        if carrier.sum() > 2:
            self.motion = np.polyfit(frame.nodes[carrier, 0] - self.middle, frame.displacement[carrier, 1], 1)
        depth = scenery.layer_thickness() or 0.1 * self.half
        largest = np.abs(frame.displacement[inside, 1] - self.reference(frame.nodes[inside, 0])).max(initial=0)
        # The layer's shape is left and, of the circle, what is near the contact.
        bounds = [0.3 * depth / largest] if largest > 0 else []
        self.magnify = magnify or rounded(min((*bounds, 1.2 * scenery.radius / self.half)))

    def reference(self, xi):
        return np.polyval(self.motion, xi - self.middle)

    def lever_points(self):
        frame = self.scenery.frame
        xi = frame.nodes[:, 0] + frame.displacement[:, 0]
        across = frame.nodes[:, 1] + self.magnify * (frame.displacement[:, 1] - self.reference(xi))
        return np.column_stack((xi, across))

    def circle(self, xi):
        """eta of the cylinder's undeformed surface at xi, as drawn."""
        return self.scenery.offset + self.magnify * (self.surface(xi) - self.scenery.offset - self.reference(xi))

    def surface(self, xi):
        height = self.scenery.radius**2 - (xi - self.centre[0]) ** 2
        return self.centre[1] + np.sqrt(np.maximum(height, 0))

    def cylinder_points(self):
        """Returns the cylinder's nodes, as deep below the drawn surface as below the true one."""
        frame = self.scenery.frame
        rest = frame.nodes + self.centre
        xi = rest[:, 0] + frame.displacement[:, 0]
        turned = self.reference(rest[:, 0]) - self.reference(xi)
        depth = self.surface(rest[:, 0]) - rest[:, 1]
        return np.column_stack((xi, self.circle(rest[:, 0]) - depth + self.magnify * (frame.displacement[:, 1] + turned)))

    def points(self):
        cylinder = self.scenery.frame.shown(["cylinder"])[:, None]
        return np.where(cylinder, self.cylinder_points(), self.lever_points())


def draw_contact(axes, window):
    """Returns what a colour bar stands for."""
    scenery, frame = window.scenery, window.scenery.frame
    points = window.points()
    low, high = scenery.offset - 0.25 * window.half, scenery.offset + 0.5 * window.half
    inside = (np.abs(points[:, 0] - window.middle) < window.half) & (points[:, 1] > low) & (points[:, 1] < high)
    # Whichever part is asked for: here it is the contact.
    coloured = CHOICES["all"]
    norm = make_norm([frame.stress[inside & frame.shown(coloured)]])
    mappable = draw_stress(axes, frame, points, coloured, norm) or make_mappable(norm)
    cells = points[frame.outlines[inside[frame.outlines].any(axis=1)]]
    add(axes, PolyCollection(cells, facecolor="none", edgecolor="white", linewidth=0.3, zorder=3))
    add(axes, LineCollection(points[frame.borders()], colors="black", linewidths=0.8, zorder=4))
    if not scenery.elastic_cylinder:
        xi = np.linspace(window.middle - window.half, window.middle + window.half, 400)
        axes.fill_between(xi, window.circle(xi), low - 1, facecolor="0.94", zorder=1)
        axes.plot(xi, window.circle(xi), color="0.3", linewidth=0.9, zorder=5)
    axes.set_ylim(low, high)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_ylabel(r"$\eta$ [mm]")
    return mappable


def draw_tractions(axes, window):
    scenery, face = window.scenery, window.scenery.result.friction_face
    if face is None or len(face.time) == 0:
        axes.annotate("no pressure was written", (0.5, 0.5), xycoords="axes fraction", ha="center")
    else:
        step = np.abs(face.time - scenery.column("time")).argmin()
        near = np.abs(face.xi - window.middle) <= 1.02 * window.half
        for values, name, colour in ((face.pressure, "pressure $p$", COLOURS[0]), (face.traction, "traction $t$", COLOURS[1])):
            axes.plot(face.xi[near], values[step][near], color=colour, label=name, linewidth=1)
        axes.axhline(0, color="black", linewidth=0.5)
        axes.legend(loc="upper left", handlelength=1.5)
    axes.set_xlim(window.middle + window.half, window.middle - window.half)  # away from the pivot to the left, as above
    axes.set_ylabel("[MPa]")
    axes.set_xlabel(r"lever coordinate $\xi$ from the pivot [mm]")


# The picture


def caption(scenery, magnify, window):
    way = {sign: name for name, sign in WAYS.items()}[scenery.way]
    theta = np.degrees(scenery.pose.theta)
    time, force = scenery.column("time"), scenery.column("P")
    state = f"x = {scenery.pose.x:.4g} mm {way}, t = {time:.5g} s, \N{GREEK SMALL LETTER THETA} = {theta:.4g}°, P = {force:.4g} N"
    above = "" if magnify == 1 else f" (elastic displacement × {magnify:g}; dotted: without it)"
    below = "" if window.magnify == 1 else f", distances and displacements across × {window.magnify:g}"
    return f"{scenery.result.name}: {state}", f"apparatus{above}", f"contact in lever axes{below}"


def fields(result, x=None, way=None, magnify=None, part="all", magnify_contact=None):
    """The frame nearest to x. Throws NotAResult where there is none near, or no such part in it."""
    if is_solid(result) and (part != "all" or magnify_contact):
        raise NotAResult(f"{result.folder}: --part and --magnify-contact are for runs in a plane")
    if is_solid(result):
        return solid_fields(result, x, way, magnify)
    scenery = Scenery(result, chosen_frame(result, x, way), part)
    check_part(scenery)
    magnify = magnify or automatic_magnification(scenery)
    window = Window(scenery, magnify_contact)
    figure = plt.figure()
    grid = figure.add_gridspec(3, 2, width_ratios=(1, 0.02))
    whole, zoom = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, 0])
    below = figure.add_subplot(grid[2, 0], sharex=zoom)
    for row, mappable in enumerate((draw_apparatus(whole, scenery, magnify), draw_contact(zoom, window))):
        bar = figure.add_subplot(grid[row, 1])
        figure.colorbar(mappable, cax=bar, label="von Mises [MPa]", extend="both" if is_logarithmic(mappable) else "max")
    draw_tractions(below, window)
    zoom.tick_params(bottom=False, labelbottom=False)
    fit(figure, grid, (axes_shape(whole), axes_shape(zoom)))
    title, *panels = caption(scenery, magnify, window)
    figure.suptitle(title, fontsize=8)
    for axes, letter, text in zip((whole, zoom, below), "abc", (*panels, "pressure and friction traction on the lever")):
        axes.set_title(f"({letter}) {text}", loc="left", fontsize=8)
    return figure


def axes_shape(axes):
    """Height over width of what is seen."""
    return float(abs(np.ptp(axes.get_ylim()) / np.ptp(axes.get_xlim())))


def fit(figure, grid, shapes):
    """Rows as high as the pictures in them at the full width."""
    heights = [np.clip(PANEL * shape, 0.2 * PANEL, 0.8 * PANEL) for shape in shapes] + [0.24 * PANEL]
    grid.set_height_ratios(heights)
    figure.set_size_inches(TWO_COLUMNS, sum(heights) + 50 * MILLIMETRE)


def check_part(scenery):
    there = set(scenery.frame.part) | (set(scenery.leaf.part) if scenery.leaf is not None else set())
    names = [name for name, parts in CHOICES.items() if parts[0] in there and name != "all"]
    if scenery.part not in ("all", *names):
        raise NotAResult(f"{scenery.result.folder}: no {scenery.part} in its fields; there are {', '.join(names)}")


def magnification(text):
    """Returns the magnification, None for auto."""
    if text == "auto":
        return None
    value = float(text)
    if not value > 0:
        raise ValueError(text)
    return value


def read_arguments(arguments):
    parser = make_parser(__doc__)
    add_folders(parser, 1, "result folder with fields (Output/Fields)")
    parser.add_argument("--x", type=float, help="position of the cylinder [mm]; default: the frame of the largest P")
    parser.add_argument("--way", choices=WAYS, help="of motion; default: either")
    parser.add_argument("--magnify", type=magnification, metavar="NUMBER|auto", help="elastic displacement in the whole (auto)")
    parser.add_argument("--magnify-contact", type=magnification, metavar="NUMBER|auto", help="distances at the contact (auto)")
    parser.add_argument("--part", choices=CHOICES, default="all", help="which is shown and coloured (all)")
    add_output(parser, default="fields.png or, as asked, fields-x30-backward.png in the folder")
    return parser.parse_args(arguments)


def default_name(options):
    """Tells what was asked for."""
    part = options.part if options.part != "all" else None
    return "-".join(filter(None, ("fields", f"x{options.x:g}" if options.x is not None else None, options.way, part)))


@script
def main(arguments=None):
    options = read_arguments(arguments)
    use_print_style()
    (folder,) = options.folders
    result = read_result(folder)
    figure = fields(result, options.x, options.way, options.magnify, options.part, options.magnify_contact)
    save(figure, picture_paths(options, folder / default_name(options)))


if __name__ == "__main__":
    sys.exit(main())
