#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws up to 20 results in one picture, told apart by the parameter that differs between them.

Runs that differ in method alone, as in model or mesh: P over time, at the first reversal, and how far each is from the finest.
Runs of different devices: P and Q over x or, with inertia, over time, and their main numbers over the parameter.
Results of other types: their curves, eigenvalues or boundaries. plot.py draws more pictures of them.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.ticker import MaxNLocator

from arguments import add_folders, add_output, make_parser, picture_paths, save, script
from sprag.results import WAYS, NotAResult, read_result
from forces import forces_over_time, forces_over_x
from overlays import draw_number, overlays
from several import FEW_NUMBERS, distinguish
from style import MILLIMETRE, TWO_COLUMNS, envelope, is_signal, label, panel_letter, plt, use_print_style
from transient import LEAD, WINDOW, has_reversal, is_transient, parameter, reversal_time, turning_points, zoom_end

LEVELS = ("closed form", "rigid", "beam", "condensed", "finite element")  # from coarse to fine
NUMBERS = ("peak_P_forward", "peak_P_backward", "loop_area")  # of a summary, drawn over the parameter
DRIVEN = ("quasi-static", "transient", "sprag slip")  # types that follow the cylinder


class View(NamedTuple):
    """A span of time, drawn from an origin in other units; of deviations the envelope over so many parts."""

    begin: float
    end: float
    origin: float
    scale: float
    parts: int


def comparisons(results):
    """{picture name: figure}. Throws NotAResult where there are too many, or they have nothing in common."""
    if not all(result.type in DRIVEN for result in results):
        return overlays(results)
    check_steps(results)
    pictures, in_time = {"comparison": comparison(results)}, any(is_transient(result) for result in results)
    if in_time or distinguish(results).is_numerical:
        pictures["forces-over-x"] = forces_over_x(results)
    if in_time:
        pictures["forces-over-time"] = forces_over_time(results)
    if all(result.friction_face is not None and result.friction_face.zeta is None for result in results):
        pictures["pressure"] = pressures(results)
    return {name: figure for name, figure in pictures.items() if figure}


def comparison(results):
    """The one picture that says most of runs along a drive."""
    several = distinguish(results)
    if several.is_numerical:
        return over_time(results, several, draw_deviations)
    if any(is_transient(result) for result in results):
        return over_time(results, several, draw_tangential, choose_numbers(results, several))
    return over_x(results, several, choose_numbers(results, several))


def check_steps(results):
    """Throws NotAResult where there are none yet."""
    for result in results:
        if len(result.table["time"]) == 0:
            reason = result.summary.get("status")
            raise NotAResult(f"{result.folder}: " + (f"no step was made: {reason}" if reason else "no step is finished yet"))


# Over x


def choose_numbers(results, several):
    """Entries of the summaries that are worth a panel each; none where the parameter has too few values for a curve."""
    if several.values is None or len(np.unique(several.values)) < FEW_NUMBERS:
        return ()
    return [name for name in NUMBERS if all(name in result.summary for result in results)]


def make_panels(rows, columns, numbers):
    """A figure with so many rows of equal panels and below them one for each of the numbers: figure, panels [rows][columns], rest."""
    height = {1: 76, 2: 115}[rows] + (52 if numbers else 0)
    figure = plt.figure(figsize=(TWO_COLUMNS, height * MILLIMETRE))
    grid = figure.add_gridspec(rows + bool(numbers), 6)
    width = 6 // columns
    panels = [[figure.add_subplot(grid[row, width * i : width * (i + 1)]) for i in range(columns)] for row in range(rows)]
    rest = [figure.add_subplot(grid[rows, 2 * i : 2 * i + 2]) for i in range(len(numbers))]
    for axes, letter in zip([axes for row in panels for axes in row] + rest, "abcdefg"):
        panel_letter(axes, letter)
    return figure, panels, rest


def over_x(results, several, numbers):
    """P and Q of all; below, the numbers over the parameter."""
    figure, (forces,), rest = make_panels(1, 2, numbers)
    for axes, column in zip(forces, "PQ"):
        for result, name, look in zip(results, several.names, several.looks):
            axes.plot(result.table["x"], result.table[column], label=name, **{"linewidth": 0.9, **look})
        axes.axhline(0, color="black", linewidth=0.5)
        axes.set_xlabel(label(results[0].units, "x"))
        axes.set_ylabel(label(results[0].units, column))
    for axes, name in zip(rest, numbers):
        draw_number(axes, results, several, name)
    several.explain(figure, [*forces, *rest], forces[1])
    return figure


# Over time


def over_time(results, several, draw_second, numbers=()):
    """P over time and at the first reversal; below it what is asked for, and the numbers over the parameter."""
    finest = max(results, key=level)  # of several the first
    views = choose_views(finest, results)
    figure, panels, rest = make_panels(2, len(views), numbers)
    for column, view in enumerate(views):
        draw_forces(panels[0][column], results, several, view, "P")
        draw_second(panels[1][column], results, several, view)
        panels[0][column].tick_params(labelbottom=False)
    for row in panels:
        for axes in row[1:]:
            axes.sharey(row[0])
            axes.tick_params(labelleft=False)
    panels[0][0].set_ylabel(label(finest.units, "P"))
    for axes, over in zip(panels[1], (label(finest.units, "time"), "$t$ from the turning point [ms]")):
        axes.set_xlabel(over)
    for axes, name in zip(rest, numbers):
        draw_number(axes, results, several, name)
    several.explain(figure, [*panels[0], *panels[1], *rest], panels[0][-1])
    return figure


def level(result):
    """Sorts results from coarse to fine: by model, then by degrees of freedom of the mesh."""
    name = parameter(result, "Analysis", "Model", "")
    return LEVELS.index(name) if name in LEVELS else -1, result.meta.get("degrees_of_freedom", 0)


def choose_views(finest, results):
    """All, and the first reversal in milliseconds."""
    everything = View(0, max(result.table["time"].max() for result in results), 0, 1, 150)
    if len(turning_points(finest)) == 0:
        return [everything]
    turn = reversal_time(finest)
    ends = [zoom_end(result) for result in results if is_transient(result) and has_reversal(result)]
    return [everything, View(turn - LEAD, turn + max(ends, default=WINDOW), turn, 1e3, 50)]


def draw_forces(axes, results, several, view, column):
    for result, name, look in zip(results, several.names, several.looks):
        shown = (result.table["time"] >= view.begin) & (result.table["time"] <= view.end)
        draw_curve(axes, result.table["time"][shown], result.table[column][shown], view, label=name, **look)
    axes.axhline(0, color="black", linewidth=0.5)


def draw_tangential(axes, results, several, view):
    draw_forces(axes, results, several, view, "Q")
    if view.origin == 0:
        axes.set_ylabel(label(results[0].units, "Q"))


def draw_deviations(axes, results, several, view):
    """Draws the deviations from the finest result, whose values are interpolated linearly."""
    finest = max(results, key=level)
    reference = finest.table["P"]
    peak = np.nanmax(np.abs(reference)) or 1
    highest = 0
    for result, look in zip(results, several.looks):
        if result is finest:
            continue
        time = result.table["time"]
        size = np.abs(result.table["P"] - np.interp(time, finest.table["time"], reference, np.nan, np.nan)) / peak
        size[size == 0] = np.nan
        draw_curve(axes, *envelope(time, size, view.begin, view.end, view.parts), view, **look)
        highest = np.fmax(highest, np.fmax.reduce(size))
    if is_signal(highest, 1):
        axes.set_yscale("log")
        axes.set_ylim(1e-5 * highest, 3 * highest)
    else:
        for line in axes.lines[:]:
            line.remove()
        axes.annotate("all the same but for round-off", (0.5, 0.5), xycoords="axes fraction", ha="center")
        axes.set_yticks([])
    if view.origin == 0:
        axes.set_ylabel(r"envelope of $|\Delta P|$ / peak of $P$")
        axes.set_title(f"deviation from {several.names[results.index(finest)]}", loc="right", fontsize=7)


def draw_curve(axes, time, values, view, **look):
    axes.plot(view.scale * (time - view.origin), values, **{**look, "linewidth": 0.9})
    axes.set_xlim(view.scale * (view.begin - view.origin), view.scale * (view.end - view.origin))


# The contact


def pressures(results, x=None):
    """Pressure and friction traction of all at one x, each way, and how far the pressure is from that of the first, of runs that differ
    in method alone of the finest; None without contact.

    x [mm]: 0.9 of the largest one that all reach unless it is given. Runs that have no step there are shifted by what they miss.
    """
    several = distinguish(results)
    x = 0.9 * min(float(result.friction_face.x.max()) for result in results) if x is None else x
    x = results[0].face(x).x
    reference = results.index(max(results, key=level)) if several.is_numerical else 0
    figure, panels = plt.subplots(3, 2, sharex="col", sharey="row", figsize=(TWO_COLUMNS, 130 * MILLIMETRE))
    for column, way in enumerate(WAYS):
        try:
            faces = [result.face(x, way) for result in results]
        except NotAResult:
            continue  # a drive may end before it turns back
        draw_faces(panels[:, column], faces, several, x, reference)
        panels[0, column].set_title(f"({'ab'[column]}) {way}, $x$ = {x:.4g} mm", loc="left", fontsize=8)
        panels[2, column].set_xlabel(r"lever coordinate $\xi$ [mm]")
        panels[2, column].xaxis.set_major_locator(MaxNLocator(5))
    if not any(axes.lines for axes in panels.flat):
        plt.close(figure)
        return None
    for axes, text in zip(panels[:, 0], ("pressure [MPa]", "traction [MPa]", "difference [MPa]")):
        axes.set_ylabel(text)
    panels[2, 0].set_title(f"pressure less that of {several.names[reference]}", loc="left", fontsize=8)
    for axes in panels.flat:
        axes.set_visible(bool(axes.lines))
    several.explain(figure, panels.flat, panels[1, 1] if panels[1, 1].lines else panels[1, 0])
    return figure


def draw_faces(panels, faces, several, x, reference):
    """Draws the pressure over xi, moved by the difference of each step's x from `x`, along which the contact moves."""
    places = [face.xi + (face.x - x) for face in faces]
    pressed = np.concatenate([place[face.pressure > 0] for place, face in zip(places, faces)])
    if len(pressed) == 0:
        return
    low, high = pressed.min(), pressed.max()
    room = 0.05 * (high - low)
    for place, face, name, look in zip(places, faces, several.names, several.looks):
        near = (place > low - 4 * room) & (place < high + 4 * room)
        compared = np.interp(place[near], places[reference], faces[reference].pressure)
        for axes, values in zip(panels, (face.pressure[near], face.traction[near], face.pressure[near] - compared)):
            axes.plot(place[near], values, label=name, **look)
    panels[0].set_xlim(low - room, high + room)
    if not any(is_signal(line.get_ydata(), faces[0].pressure) for line in panels[2].lines):
        panels[2].annotate("all the same but for round-off", (0.5, 0.75), xycoords="axes fraction", ha="center")
        panels[2].set_yticks([])


@script
def main(arguments=None):
    parser = make_parser(__doc__)
    add_folders(parser)
    add_output(parser, default="comparison.png here")
    options = parser.parse_args(arguments)
    use_print_style()
    results = [read_result(folder) for folder in options.folders]
    pictures = comparisons(results)
    save(pictures.get("comparison") or next(iter(pictures.values())), picture_paths(options, Path("comparison")))


if __name__ == "__main__":
    sys.exit(main())
