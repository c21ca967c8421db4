#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws the device of a scene to scale, with its dimensions, angles and forces.

From FILE.prm the program makes a coarse mesh and the closed form's forces; from a result folder with fields its own mesh is taken, so
that nothing is run but the closed form. The cylinder moves forward, towards the pivot, and stands at the x asked for.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.patches import Circle, Polygon

from apparatus import connectors, make_device
from arguments import add_output, add_program, make_parser, picture_paths, save, script
from drafting import CENTRE_LINE, HIDDEN, angle, dimension, force, ground, note, outline, pointer, spiral, zigzag
from sprag.results import NotAResult
from style import COLOURS, MILLIMETRE, TWO_COLUMNS, plt, use_print_style

FILLS = {
    "lever": "#d7e3ee",
    "web": "#e9eff5",
    "layer": "#c98f4a",
    "hub": "#c3ccd6",
    "plate": "#b9cfe0",
    "cylinder": "#ececec",
    "leaf": "#5b6b7a",
    "sensor": COLOURS[1],
    "guide": COLOURS[2],
}
EDGE = {"edgecolor": "0.2", "linewidth": 0.6}


# The parts


def draw_lever(axes, device, geometry, mirrored=False):
    """Lever, layer, plate, sensors and leaf spring, of a mirrored one below the cylinder's path. Its mesh's places on the page."""
    points = geometry.place(device.frame.nodes)
    turn = (lambda places: places * (1, -1)) if mirrored else (lambda places: places)
    points = turn(points)
    for part in ("hub", "lever", "web", "plate", "layer"):
        if device.frame.shown([part]).any():
            outline(axes, points, device.frame.borders([part]), facecolor=FILLS[part], zorder=3, gid=part, **EDGE)
    if device.leaf is not None:
        leaf = turn(device.leaf_points(geometry))
        outline(axes, leaf, device.leaf.borders(["leaf"]), facecolor=FILLS["leaf"], zorder=3, gid="leaf", edgecolor="0.2", linewidth=0.3)
    for corners, kind in connectors(device):
        axes.add_patch(Polygon(turn(geometry.place(corners)), facecolor=FILLS[kind], edgecolor="0.2", linewidth=0.4, zorder=3))
    pivot = turn(geometry.pivot)
    axes.add_patch(Circle(pivot, 0.022 * geometry.pivot[0], facecolor="white", edgecolor="black", linewidth=1, zorder=6, gid="pivot"))
    return points


def draw_cylinder(axes, device, geometry):
    centre = (geometry.x, 0.0)
    axes.add_patch(Circle(centre, geometry.radius, facecolor=FILLS["cylinder"], zorder=2, gid="cylinder", **EDGE))
    axes.add_patch(Circle((0.0, 0.0), geometry.radius, facecolor="none", zorder=1, gid="cylinder at rest", edgecolor="0.55", linewidth=0.6, linestyle=(0, (1, 2))))
    if device.text("Cylinder/Type") != "rigid":
        axes.add_patch(Circle(centre, device.number("Cylinder/Inner radius"), facecolor="0.8", zorder=2.1, edgecolor="0.4", linewidth=0.5))
    for x in (0.0, geometry.x):
        axes.plot(x, 0.0, "+", color="0.2", markersize=6, markeredgewidth=0.6, zorder=7)


def draw_support(axes, device, geometry, size):
    """Draws the support of the pivot, and the rotational spring unless it is a leaf spring; a pair's pivots are drawn free."""
    pivot = geometry.pivot
    if device.leaf is None:
        spiral(axes, pivot, 0.55 * size, color=COLOURS[3], linewidth=1.2, zorder=5, gid="spring")
    if device.is_pair:
        return
    foot, side = pivot - (0, size), np.array((size, 0))
    axes.add_patch(Polygon([pivot, foot + 0.45 * side, foot - 0.45 * side], facecolor="white", edgecolor="black", linewidth=0.8, zorder=4.5))
    if device.text("Support/Type") == "rigid":
        ground(axes, foot - 0.7 * side, foot + 0.7 * side, 0.18 * size)
        return
    axes.plot(*np.transpose((foot - 0.7 * side, foot + 0.7 * side)), color="black", linewidth=1)
    up = np.array((0, 0.35 * size))
    wall = foot + 2.3 * side + up
    zigzag(axes, foot + 0.25 * side + up, wall, 0.35 * size, color="black", linewidth=0.8, zorder=4)
    ground(axes, wall + up, wall - up, 0.18 * size)
    pointer(axes, "spring of\nthe support", foot + 1.4 * side + 0.9 * up, foot + 1.4 * side - 1.6 * up)


# The picture


def drawing(device, x=None):
    """The figure. x: of the cylinder, its largest unless given. Throws NotAResult where there is no contact."""
    if x is None:
        x = device.largest_x if device.largest_x is not None else device.number("Drive/Stroke")
    geometry = device.geometry(x)
    if not abs(geometry.theta) < np.pi / 2 or geometry.s <= 0:
        raise NotAResult(f"{device.name}: no contact at x = {x:g} mm")
    figure, axes = plt.subplots(figsize=(TWO_COLUMNS, 100 * MILLIMETRE))
    draw_cylinder(axes, device, geometry)
    points = draw_lever(axes, device, geometry)
    if device.is_pair:
        draw_lever(axes, device, device.geometry(x, -1), mirrored=True)
    draw_support(axes, device, geometry, 0.13 * geometry.pivot[0])
    draw_dimensions(axes, device, geometry, points)
    draw_forces(axes, device, geometry, find_top(device, geometry))
    name_parts(axes, device, geometry, points)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(caption(device, x), fontsize=7.5, loc="left")
    fit(figure, axes)
    return figure


def caption(device, x):
    off = f", {device.cylinder_height:g} mm off the mirror plane" if device.cylinder_height else ""
    return (
        f"{device.name}, to scale. The cylinder moves towards the pivot and is at $x$ = {x:.4g} mm{off}; dotted: $x$ = 0.\n"
        "$P$, $F$ and their part $Q$ along $x$ act on the lever"
        + (", in a scale of their own." if device.forces else "; their sizes are not known, $F/P$ is the friction coefficient.")
    )


def find_top(device, geometry):
    """Returns the largest coordinate across the lever above its contact."""
    near = np.abs(device.frame.nodes[:, 0] - geometry.s) < 0.1 * geometry.pivot[0]
    solid = device.frame.shown(["lever", "web", "plate", "layer", "hub"])
    return device.frame.nodes[near & solid if (near & solid).any() else solid, 1].max()


def draw_dimensions(axes, device, geometry, points):
    R, pivot = geometry.radius, geometry.pivot
    unit = pivot[0]
    lower = -1.2 * R - (0 if has_room(geometry) else 0.08 * unit)
    if device.is_pair:
        lower = min(lower, -points[:, 1].max() - 0.08 * unit)
    axes.plot([-0.2 * unit, 1.15 * unit], [0, 0], **CENTRE_LINE, zorder=1)
    draw_radius(axes, geometry)
    if geometry.x > 0:
        below = {"away": (0, -7)} if geometry.x < 0.3 * unit else None  # the arrow is too short for words on it
        dimension(axes, (0, 0), (geometry.x, 0), f"$x$ = {geometry.x:.4g} mm", (0, lower), words=below)
    dimension(axes, (0, 0), (unit, 0), f"$l$ = {unit:.4g} mm", (0, lower - 0.11 * unit))
    if pivot[1] != 0 and not device.is_pair:
        dimension(axes, (unit, 0), pivot, f"$h$ = {pivot[1]:.4g} mm".replace("-", "\N{MINUS SIGN}"), (0.24 * unit, 0), words={"ha": "left"})
    if geometry.offset > 0:
        right = -0.14 * unit * geometry.along
        dimension(axes, pivot, geometry.foot, f"  $e$ = {geometry.offset:.4g} mm", right, words={"ha": "left", "bbox": None})
    axes.plot(*np.transpose((geometry.foot, geometry.contact)), **HIDDEN, zorder=4, gid="face")
    above = ((points - pivot) @ geometry.across).max() - geometry.offset
    rise = (above + 0.04 * unit) * geometry.across
    dimension(axes, geometry.foot, geometry.contact, f"$s$ = {geometry.s:.4g} mm", rise, 0.4)
    axes.plot(*geometry.contact, "o", color="black", markersize=3, zorder=9, gid="contact")
    draw_angles(axes, geometry, device.number("Lever/Length"))


def has_room(geometry):
    """Tells if the cylinder is large enough for the name of its radius."""
    return geometry.radius > 0.2 * geometry.pivot[0]


def draw_radius(axes, geometry):
    """Named within the cylinder where there is room, else beside it."""
    slant = np.array((np.cos(np.radians(212)), np.sin(np.radians(212))))
    centre, surface = np.array((geometry.x, 0.0)), np.array((geometry.x, 0.0)) + geometry.radius * slant
    dimension(axes, centre, surface, f"$R$ = {geometry.radius:.4g} mm" if has_room(geometry) else "", arrowstyle="-|>")
    if not has_room(geometry):
        note(axes, f"$R$ = {geometry.radius:.4g} mm", surface, (-2, -2), ha="right", va="top")


def draw_angles(axes, geometry, length):
    pivot = geometry.pivot
    axes.plot([pivot[0] - 1.55 * length, pivot[0]], [pivot[1]] * 2, **CENTRE_LINE, zorder=1)
    for theta, reach, name, gid in ((geometry.theta, 1.18, r"$\theta$", "axis"), (geometry.theta_0, 1.42, r"$\theta_0$", "axis at rest")):
        end = pivot + (reach + 0.07) * length * np.array((-np.cos(theta), np.sin(theta)))
        axes.plot(*np.transpose((pivot, end)), **HIDDEN, zorder=1, gid=gid)
        angle(axes, pivot, reach * length, np.pi - theta, np.pi, f"{name} = {np.degrees(theta):.3g}°", (-3, 0 if theta >= 0 else -8))


def draw_forces(axes, device, geometry, top):
    """P along n, F along -d from its tip, and Q, what the two are along x: one scale for the three."""
    forces, unit = device.forces, geometry.pivot[0]
    mu = forces.F / forces.P if forces and forces.P > 0 else device.number("Friction/Coefficient")
    said = {name: f"${name}$ = {getattr(forces, name):.3g} N" if forces else f"${name}$" for name in "PFQ"}
    normal = (top - geometry.offset + 0.2 * unit) * geometry.across
    friction = -mu * np.linalg.norm(normal) * geometry.along
    tip = geometry.contact + normal
    along_x = (normal + friction)[0]
    above = max(tip[1], (tip + friction)[1]) + 0.07 * unit
    for begin, x in ((geometry.contact[1], geometry.contact[0]), ((tip + friction)[1], geometry.contact[0] + along_x)):
        axes.plot([x, x], [begin, above], color="0.5", linewidth=0.4, linestyle=":", zorder=4)
    force(axes, geometry.contact, normal, said["P"], COLOURS[0], (-7, -4), "P", "right")
    force(axes, tip, friction, said["F"], COLOURS[1], (4, -1), "F")
    force(axes, (geometry.contact[0], above), (along_x, 0), said["Q"], COLOURS[2], (4, 0), "Q")


def name_parts(axes, device, geometry, points):
    """Names in a column left of the lever, and of what is at the pivot beside it."""
    frame, pivot = device.frame, geometry.pivot
    unit, tip = pivot[0], device.number("Lever/Length")

    def at(part, xi):
        nodes = np.flatnonzero(frame.shown([part]))
        return points[nodes[np.abs(frame.nodes[nodes, 0] - xi).argsort()[:8]]].mean(axis=0)

    column = [("lever", at("lever", 0.93 * tip))]
    boxes = [geometry.place(corners).mean(axis=0) for corners, _ in connectors(device)]
    if boxes:
        plate_tip = device.number("Friction plate/End")
        column += [("guide", boxes[-1]), ("force sensor", boxes[-2]), ("friction plate", at("plate", plate_tip))]
    if frame.shown(["layer"]).any():
        column.append(("friction layer", at("layer", 0.9 * tip)))
    left, top = points[:, 0].min(), points[:, 1].max()
    for index, (name, place) in enumerate(column):
        pointer(axes, name, place, (left - 0.07 * unit, top + (0.1 - 0.085 * index) * unit), ha="right")
    edge = geometry.x + 0.75 * geometry.radius + 0.13 * unit
    if edge > 0.95 * unit:  # it hides where the pivot's name would stand
        pointer(axes, "cylinder", (geometry.x + 0.5 * geometry.radius, -0.8 * geometry.radius), (edge, -1.05 * geometry.radius), ha="left")
    else:
        pointer(axes, "cylinder", (geometry.x + 0.6 * geometry.radius, -0.5 * geometry.radius), (edge, -0.5 * geometry.radius - 0.04 * unit), ha="left")
        pointer(axes, "pivot", pivot, (0.86 * unit, pivot[1] - 0.1 * unit), ha="right")
    if device.leaf is None:
        words = f"rotational spring\n$k$ = {device.number('Rotational spring/Stiffness'):g} N mm/rad"
        pointer(axes, words, pivot + (0.06 * unit, -0.03 * unit), ((1.27 if device.text("Support/Type") == "rigid" else 1.36) * unit, pivot[1] - 0.12 * unit), ha="left")
    else:
        leaf = device.leaf_points(geometry)
        end = leaf[leaf[:, 0] > leaf[:, 0].min() + 0.75 * np.ptp(leaf[:, 0])].mean(axis=0)
        pointer(axes, "leaf spring", end, (end[0], pivot[1] - 0.2 * unit))


def fit(figure, axes):
    """The page as high as what is drawn at its full width."""
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    for _ in range(3):
        boxes = [artist.get_window_extent(renderer) for artist in (*axes.lines, *axes.patches, *axes.texts)]
        corners = axes.transData.inverted().transform(np.concatenate([(box.min, box.max) for box in boxes if np.isfinite(box.extents).all()]))
        low, high = corners.min(axis=0), corners.max(axis=0)
        room = 0.01 * (high[0] - low[0])
        axes.set_xlim(low[0] - room, high[0] + room)
        axes.set_ylim(low[1] - room, high[1] + room)
        width, height = high - low + 2 * room
        figure.set_size_inches(TWO_COLUMNS, (TWO_COLUMNS - 4 * MILLIMETRE) * height / width + 10 * MILLIMETRE)
        figure.canvas.draw()


@script
def main(arguments=None):
    parser = make_parser(__doc__)
    parser.add_argument("scene", type=Path, metavar="FILE.prm|DIR", help="a scene, or the folder of a result")
    parser.add_argument("--x", type=float, help="position of the cylinder [mm]; default: the end of the stroke")
    add_output(parser, default="device.png in the folder, or FILE-device.png here")
    add_program(parser)
    options = parser.parse_args(arguments)
    use_print_style()
    if not options.scene.exists():
        raise NotAResult(f"{options.scene}: no such file")
    figure = drawing(make_device(options.scene, options.sprag, options.x), options.x)
    default = options.scene / "device" if options.scene.is_dir() else Path(f"{options.scene.stem}-device")
    save(figure, picture_paths(options, default))


if __name__ == "__main__":
    sys.exit(main())
