"""One picture of several runs of one scene: the levels of fidelity against the finest."""

from typing import NamedTuple

import numpy as np

from style import MILLIMETRE, TWO_COLUMNS, envelope, label, legend_on_top, look, panel_letter, plt
from transient import LEAD, WINDOW, has_reversal, is_transient, parameter, reversal_time, turning_points, zoom_end

LEVELS = ("closed form", "rigid", "beam", "condensed", "finite element")  # from coarse to fine


class View(NamedTuple):
    """A span of time, drawn from an origin in other units; of deviations the envelope over so many parts."""

    begin: float
    end: float
    origin: float
    scale: float
    parts: int


def comparison(results):
    """P over time and at the first reversal; below, how far each is off the finest, relative to that one's peak."""
    finest = max(results, key=level)  # of several the first
    names = names_of(results)
    views = views_of(finest, results)
    figure, panels = plt.subplots(
        2, len(views), sharex="col", sharey="row", squeeze=False, figsize=(TWO_COLUMNS, 115 * MILLIMETRE)
    )  # fmt: skip
    for (forces, deviations), view in zip(panels.T, views):
        draw_forces(forces, results, view)
        draw_deviations(deviations, results, finest, view)
    panels[0][0].set_ylabel(label(finest.units, "P"))
    panels[1][0].set_ylabel(r"envelope of $|\Delta P|$ / peak of $P$")
    for axes, over in zip(panels[1], (label(finest.units, "time"), "$t$ from the turning point [ms]")):
        axes.set_xlabel(over)
    for axes, letter in zip(panels.flat, "abcd"):
        panel_letter(axes, letter)
    panels[1][0].set_title(f"deviation from {names[results.index(finest)]}", loc="right", fontsize=7)
    legend_on_top(figure, panels[0][0].get_lines()[: len(names)], names)
    return figure


def level(result):
    name = parameter(result, "Analysis", "Model", "")
    return LEVELS.index(name) if name in LEVELS else -1


def names_of(results):
    """The models; with the folder where that does not tell them apart."""
    models = [parameter(result, "Analysis", "Model", "") for result in results]
    return [
        model if model and models.count(model) == 1 else f"{model} ({result.name})" if model else result.name
        for model, result in zip(models, results)
    ]


def views_of(finest, results):
    """All, and the first reversal in milliseconds."""
    everything = View(0, max(result.table["time"].max() for result in results), 0, 1, 150)
    if len(turning_points(finest)) == 0:
        return [everything]
    turn = reversal_time(finest)
    ends = [zoom_end(result) for result in results if is_transient(result) and has_reversal(result)]
    return [everything, View(turn - LEAD, turn + max(ends, default=WINDOW), turn, 1e3, 50)]


def draw_forces(axes, results, view):
    for index, result in enumerate(results):
        shown = (result.table["time"] >= view.begin) & (result.table["time"] <= view.end)
        draw_curve(axes, result.table["time"][shown], result.table["P"][shown], index, view)
    axes.axhline(0, color="black", linewidth=0.5)


def draw_deviations(axes, results, finest, view):
    """Of all but the finest, whose own values are interpolated linearly."""
    reference = finest.table["P"]
    peak = np.nanmax(np.abs(reference)) or 1
    highest = 0
    for index, result in enumerate(results):
        if result is finest:
            continue
        time = result.table["time"]
        size = np.abs(result.table["P"] - np.interp(time, finest.table["time"], reference, np.nan, np.nan)) / peak
        size[size == 0] = np.nan
        draw_curve(axes, *envelope(time, size, view.begin, view.end, view.parts), index, view)
        highest = np.fmax(highest, np.fmax.reduce(size))
    if highest > 0:
        axes.set_yscale("log")
        axes.set_ylim(1e-5 * highest, 3 * highest)


def draw_curve(axes, time, values, index, view):
    axes.plot(view.scale * (time - view.origin), values, **{**look(index), "linewidth": 0.9})
    axes.set_xlim(view.scale * (view.begin - view.origin), view.scale * (view.end - view.origin))
