# SPDX-License-Identifier: GPL-3.0-only
"""The contact of a run in three dimensions: pressure over the face where P is largest each way, and how it changes over the width."""

import numpy as np

from contact import WAYS, draw_widths, find_state_ways
from style import COLOURS, MILLIMETRE, TWO_COLUMNS, look, panel_letter, plt, set_labels, show_legend


def is_solid(result):
    return result.friction_face is not None and result.friction_face.zeta is not None


def surface(result):
    """Maps of the pressure about its centre, load and largest pressure over the width, contact width and its centre over x."""
    states = largest_states(result)
    figure = plt.figure(figsize=(TWO_COLUMNS, 118 * MILLIMETRE), constrained_layout=True)
    grid = figure.add_gridspec(2, 2)
    maps = [figure.add_subplot(grid[0, index] if len(states) > 1 else grid[0, :]) for index in range(max(len(states), 1))]
    drawn = [draw_map(axes, result.friction_face, step) for axes, (step, _) in zip(maps, states)]
    if drawn:
        top = max(mesh.get_array().max() for mesh in drawn)
        for mesh in drawn:
            mesh.set_clim(0, top)
        bar = figure.colorbar(drawn[-1], ax=maps, shrink=0.9)
        bar.set_label(f"pressure [MPa]")
    across, over_x = (figure.add_subplot(grid[1, column]) for column in range(2))
    draw_load_across(across, result.friction_face, states)
    if np.nanmax(np.abs(result.table["centre_across"]), initial=0) > 0:
        draw_centre(over_x, result)
    else:
        draw_widths(over_x, result)
    for axes, letter in zip((*maps, across, over_x), "abcd"):
        panel_letter(axes, letter)
    for axes, letter, (step, way) in zip(maps, "ab", states):
        axes.set_title(f"({letter}) {WAYS[way][0]}, x = {result.friction_face.x[step]:.3g} {result.friction_face.x.unit}", loc="left", fontsize=8)
    return figure


def largest_states(result):
    """[(row of the face's steps, way)] where the face carries most, each way."""
    force = np.asarray(result.friction_face.pressure) @ result.friction_face.weight
    ways = find_state_ways(result)
    found = []
    for way in WAYS:
        rows = np.flatnonzero((ways == way) & (force > 0))
        if len(rows):
            found.append((int(rows[force[rows].argmax()]), way))
    return found


def whole_width(face, values):
    """xi, zeta and values of the points, those of a half with their mirror images."""
    if face.zeta.min() < 0:
        return face.xi, face.zeta, values
    return np.tile(face.xi, 2), np.concatenate((face.zeta, -face.zeta)), np.tile(values, 2)


def draw_map(axes, face, step):
    """Draws the pressure on the pressed part of the face, with some room."""
    xi, zeta, pressure = whole_width(face, face.pressure[step])
    pressed = xi[pressure > 0]
    centre = 0.5 * (pressed.min() + pressed.max())
    room = 0.75 * (pressed.max() - pressed.min()) + 0.5
    near = np.abs(xi - centre) < room
    drawn = axes.tripcolor(xi[near], zeta[near], pressure[near], shading="gouraud", cmap="viridis", rasterized=True)
    axes.set_xlabel(f"lever coordinate $\\xi$ [{face.xi.unit}]")
    axes.set_ylabel(f"across, $\\zeta$ [{face.zeta.unit}]")
    return drawn


def draw_load_across(axes, face, states):
    """Force on the face by length of its width."""
    for index, (step, way) in enumerate(states):
        xi, zeta, force = whole_width(face, face.pressure[step] * face.weight)
        _, _, area = whole_width(face, face.weight)
        lines, line = np.unique(np.round(zeta, 6), return_inverse=True)
        span = face.weight.sum() / (2 * np.abs(face.zeta).max())  # length of the face where the weights are those of the width
        load = np.bincount(line, force) / np.bincount(line, area) * span
        axes.plot(lines, load, color=COLOURS[index], linestyle=WAYS[way][1], marker=".", markersize=3, linewidth=0.8, label=WAYS[way][0])
    axes.set_xlabel(f"across, $\\zeta$ [{face.zeta.unit}]")
    axes.set_ylabel("load over the width [N/mm]")
    axes.set_ylim(bottom=0)
    if len(states) > 1:
        show_legend(axes)


def draw_centre(axes, result):
    levers = [("centre_across", "first lever"), ("centre_across_2", "second lever")]
    drawn = [(name, label) for name, label in levers if name in result.table]
    for index, (name, label) in enumerate(drawn):
        axes.plot(result.table["x"], result.table[name], label=label, **look(index))
    if len(drawn) > 1:
        show_legend(axes)
    set_labels(axes, result.units, "x", "centre_across")
