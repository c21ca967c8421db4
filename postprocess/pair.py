# SPDX-License-Identifier: GPL-3.0-only
"""Draws the two levers of a full mirrored pair beside each other."""

from functools import partial

from sensors import draw_views
from style import COLOURS, LINES, is_signal, legend_on_top, plt

LEVERS = (("", "first lever"), ("_2", "second lever"))
CLOSED_FORM = {"color": "black", "linestyle": (0, (1, 2)), "linewidth": 0.8, "zorder": 3, "label": "closed form of the first"}
FORCES = (("P", "$P$"), ("F", "$F$"))
BOTH = (("swing", "swing", "theta"), ("lateral_force", "lateral force", "P"))  # and what it is a difference of


def has_pair(result):
    return all(result.has(column) for column in ("P", "P_2", "swing", "lateral_force"))


def draw_pair(result):
    """P and F of both levers, their swing and their force on the cylinder across its path, where that is not mere round-off.

    Over x, forward and backward; with inertia over time, with a look at the first reversal.
    """
    shown = [(column, name) for column, name, whole in BOTH if is_signal(result.table[column], result.table[whole])]
    ratios = (3, 3, *(2 for _ in shown))
    draw = partial(draw_column, shown=shown)
    figure, panels = draw_views(result, draw, 30 + 12 * sum(ratios), ratios)
    for axes, (column, symbol) in zip(panels[:, 0], (*FORCES, *shown)):
        axes.set_ylabel(f"{symbol} [{result.units[column]}]")
    handles, names = panels[0, 0].get_legend_handles_labels()
    if zero := [name for column, name, _ in BOTH if (column, name) not in shown]:
        handles.append(plt.Line2D([], [], linestyle=""))
        names.append(f"{' and '.join(zero)}: none but round-off")
    legend_on_top(figure, handles, names)
    figure.align_ylabels()
    return figure


def draw_column(panels, result, values, rows, shown):
    table = result.table
    across = values[rows]
    for axes, (column, _) in zip(panels, FORCES):
        for index, (suffix, name) in enumerate(LEVERS):
            line = {"color": COLOURS[index], "linestyle": LINES[index], "linewidth": 0.9}
            axes.plot(across, table[column + suffix][rows], label=name, **line)
    if result.has("P_closed_form"):
        panels[0].plot(across, table["P_closed_form"][rows], **CLOSED_FORM)
    for axes, (column, _) in zip(panels[len(FORCES) :], shown):
        axes.plot(across, table[column][rows], color="black", linewidth=0.9)
    for axes in panels:
        axes.axhline(0, color="black", linewidth=0.5, zorder=1)
