# SPDX-License-Identifier: GPL-3.0-only
"""P and Q of one or several runs over time and over x, beside the closed form."""

import numpy as np

from several import distinguish
from sprag.results import WAYS
from style import MILLIMETRE, ONE_COLUMN, TWO_COLUMNS, label, legend_on_top, panel_letter, plt, set_labels, with_unit

CLOSED_FORM = {"color": "black", "linestyle": (0, (4, 4)), "linewidth": 0.8}


def draw_column(axes, results, several, over, column):
    """A column over another, and dashed what the closed form has to say on it where that is the same for all."""
    for result, name, look in zip(results, several.names, several.looks):
        axes.plot(result.table[over], result.table[column], label=name, **look)
    if (known := shared_closed_form(results, f"{column}_closed_form")) is not None:
        axes.plot(known.table[over], known.table[f"{column}_closed_form"], label="closed form", **CLOSED_FORM)


def shared_closed_form(results, column):
    """The result whose closed form speaks for all; None where there are several answers."""
    known = [result for result in results if result.has(column)]
    if not known:
        return None
    first = known[0]
    largest = np.nanmax(np.abs(first.table[column])) or 1.0
    for other in known[1:]:
        if not np.isclose(np.nanmax(other.table["x"]), np.nanmax(first.table["x"])):
            return None
        if abs(np.nanmax(np.abs(other.table[column])) - largest) > 1e-3 * largest:
            return None
    return first


def explain(figure, panels, beside, results, several):
    """One result and the closed form by a legend; several by what tells them apart."""
    further = [pair for pair in zip(*beside.get_legend_handles_labels()) if pair[1] not in several.names]
    if len(results) == 1:
        legend_on_top(figure, *beside.get_legend_handles_labels())
    else:
        several.explain(figure, panels, beside, further)


def forces_over_time(results):
    """x, P and Q over time (Fig. 7 of the paper)."""
    several = distinguish(results)
    width = ONE_COLUMN if len(results) == 1 else 1.3 * ONE_COLUMN
    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(width, 125 * MILLIMETRE))
    for axes, column, letter in zip(panels, ("x", "P", "Q"), "abc"):
        draw_column(axes, results, several, "time", column)
        axes.set_ylabel(label(results[0].units, column))
        panel_letter(axes, letter)
    panels[-1].set_xlabel(label(results[0].units, "time"))
    figure.align_ylabels()
    explain(figure, panels, panels[1], results, several)
    return figure


def forces_over_x(results):
    """P and Q over x with the direction of motion and the line C_Q x (Figs. 8 and 9 of the paper)."""
    several = distinguish(results)
    figure, panels = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 76 * MILLIMETRE))
    for axes, column, letter in zip(panels, ("P", "Q"), "ab"):
        draw_column(axes, results, several, "x", column)
        set_labels(axes, results[0].units, "x", column)
        panel_letter(axes, letter)
    draw_slopes(panels[1], results)
    for axes, column in zip(panels, ("P", "Q")):
        draw_directions(axes, results[0], column, named=len(results) == 1)
    area = results[0].summary.get("loop_area", np.nan)
    if len(results) == 1 and np.isfinite(area):
        panels[1].set_title(f"loop area {with_unit(f'{area:.4g}', area.unit)}", loc="right", fontsize=7)
    panels[1].axhline(0, color="black", linewidth=0.5)
    explain(figure, panels, panels[1], results, several)
    return figure


def draw_slopes(axes, results):
    """The dotted line Q = C_Q x of eq. 16, where all results share it."""
    known = [r for r in results if np.isfinite(r.summary.get("slope_forward", np.nan))]
    slopes = {round(r.summary["slope_forward"], 9): r for r in known}
    for slope, result in slopes.items() if len(slopes) == 1 else ():
        end = np.nanmax(result.table["x"])
        name = f"$C_Q x$, $C_Q$ = {slope:.4f} {result.summary['slope_forward'].unit}"
        axes.plot([0, end], [0, slope * end], color="black", linestyle=":", linewidth=1.2, label=name)


def draw_directions(axes, result, column, named):
    """An arrow along the first stroke each way, with its name outside the loop."""
    x, y = result.table["x"], result.table[column]
    strokes = {way: first_stroke(x, sign) for way, sign in WAYS.items()}
    middles = {way: np.nanmean(y[stroke]) for way, stroke in strokes.items() if len(stroke) > 2}
    for way, middle in middles.items():
        end = draw_arrow(axes, x[strokes[way]], y[strokes[way]])
        if named and end is not None:
            place = middle < max(middles.values()), np.corrcoef(x[strokes[way]], y[strokes[way]])[0, 1] > 0  # below, rises
            side = 1 if place[0] == place[1] else -1
            axes.annotate(way, end, xytext=(6 * side, -6 if place[0] else 6), textcoords="offset points", fontsize=7,
                          ha="left" if side > 0 else "right", va="top" if place[0] else "bottom")  # fmt: skip


def first_stroke(x, sign):
    """Indices of the first run of steps in one direction."""
    moving = np.flatnonzero(sign * np.diff(x) > 0)
    if len(moving) == 0:
        return moving
    gaps = np.flatnonzero(np.diff(moving) > 1)
    last = moving[gaps[0]] if len(gaps) else moving[-1]
    return np.arange(moving[0] + 1, last + 2)


def draw_arrow(axes, x, y):
    """An arrow head on the curve halfway along the stroke; of a curve that vibrates on its mean. Where it ends; None without."""
    path = np.cumsum(np.abs(np.diff(x, prepend=x[0])))
    ends = []
    for share in (0.46, 0.56):
        near = np.abs(path - share * path[-1]) <= 0.03 * path[-1]
        if near.sum() < 20:  # a smooth curve in few steps
            ends.append((np.interp(share * path[-1], path, x), np.interp(share * path[-1], path, y)))
        else:
            ends.append((x[near].mean(), y[near].mean()))
    if np.isfinite(ends).all():
        arrow = {"arrowstyle": "-|>", "color": "black", "linewidth": 1, "mutation_scale": 10}
        axes.annotate("", xy=ends[1], xytext=ends[0], arrowprops=arrow)
        return ends[1]
    return None
