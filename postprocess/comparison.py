#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws up to 20 results in one picture, told apart by the parameter that differs between them.

Runs that differ in method alone, as in model or mesh: P over time, at the first reversal, and how far each is from the finest.
Runs of different devices: P and Q over x or, with inertia, over time, and their main numbers over the parameter.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

from arguments import add_folders, add_output, parser_of, picture_paths, save, script
from sprag.results import NotAResult, read_result
from several import FEW_NUMBERS, told_apart
from style import MILLIMETRE, TWO_COLUMNS, envelope, is_signal, label, panel_letter, plt, use_print_style
from transient import LEAD, WINDOW, has_reversal, is_transient, parameter, reversal_time, turning_points, zoom_end

LEVELS = ("closed form", "rigid", "beam", "condensed", "finite element")  # from coarse to fine
NUMBERS = ("peak_P_forward", "peak_P_backward", "loop_area")  # of a summary, drawn over the parameter


class View(NamedTuple):
    """A span of time, drawn from an origin in other units; of deviations the envelope over so many parts."""

    begin: float
    end: float
    origin: float
    scale: float
    parts: int


def comparison(results):
    """Throws NotAResult where there are too many."""
    several = told_apart(results)
    if several.is_numerical:
        return over_time(results, several, draw_deviations)
    if any(is_transient(result) for result in results):
        return over_time(results, several, draw_tangential, numbers_of(results, several))
    return over_x(results, several, numbers_of(results, several))


def check_steps(results):
    """Throws NotAResult where there are none that pictures could share."""
    for result in results:
        if "time" not in result.table:
            raise NotAResult(f"{result.folder}: has no steps to share a picture, a result of its type is drawn by itself")
        if len(result.table["time"]) == 0:
            reason = result.summary.get("status")
            raise NotAResult(f"{result.folder}: " + (f"no step was made: {reason}" if reason else "no step is finished yet"))


# Over x


def numbers_of(results, several):
    """Entries of the summaries that are worth a panel each; none where the parameter has too few values for a curve."""
    if several.values is None or len(np.unique(several.values)) < FEW_NUMBERS:
        return ()
    return [name for name in NUMBERS if all(name in result.summary for result in results)]


def rows_of_panels(rows, columns, numbers):
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
    figure, (forces,), rest = rows_of_panels(1, 2, numbers)
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


def draw_number(axes, results, several, name):
    order = np.argsort(several.values, kind="stable")
    numbers = np.array([float(result.summary[name]) for result in results])
    axes.plot(several.values[order], numbers[order], color="0.6", linewidth=0.8, zorder=1)
    for value, number, look in zip(several.values, numbers, several.looks):
        axes.plot(value, number, "o", color=look["color"], markersize=4)
    unit = results[0].summary[name].unit
    axes.set_ylabel(f"{name.replace('_', ' ')} [{unit}]")
    axes.set_xlabel(several.label)
    axes.ticklabel_format(axis="y", useOffset=False)


# Over time


def over_time(results, several, draw_second, numbers=()):
    """P over time and at the first reversal; below it what is asked for, and the numbers over the parameter."""
    finest = max(results, key=level)  # of several the first
    views = views_of(finest, results)
    figure, panels, rest = rows_of_panels(2, len(views), numbers)
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
    name = parameter(result, "Analysis", "Model", "")
    return LEVELS.index(name) if name in LEVELS else -1


def views_of(finest, results):
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
    """Of all but the finest, whose own values are interpolated linearly."""
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


@script
def main(arguments=None):
    parser = parser_of(__doc__)
    add_folders(parser)
    add_output(parser, default="comparison.png here")
    options = parser.parse_args(arguments)
    use_print_style()
    results = [read_result(folder) for folder in options.folders]
    check_steps(results)
    save(comparison(results), picture_paths(options, Path("comparison")))


if __name__ == "__main__":
    sys.exit(main())
