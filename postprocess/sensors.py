# SPDX-License-Identifier: GPL-3.0-only
"""Draws the forces on the sensors of a friction plate beside the normal force at the contact."""

import re

import numpy as np

from style import COLOURS, MILLIMETRE, TWO_COLUMNS, is_signal, legend_on_top, look, panel_letter, plt
from transient import LEAD, has_reversal, is_transient, reversal_time, zoom_end

PAIR = (("P", "$P$ at the contact", COLOURS[0], "-"), ("sensor_sum", "sum of the sensors", COLOURS[1], (0, (5, 1.5))))


def has_sensors(result):
    return result.has("sensor_sum") and result.has("P")


def sensor_columns(result):
    """Columns of the single sensors, counted from the pivot."""
    return sorted((name for name in result.table if re.fullmatch(r"sensor_\d+", name)), key=lambda name: int(name[7:]))


def sensor_sides(result, sensor):
    """[(column, its line)] of a sensor: in three dimensions left and right of the plate."""
    lines = (("left", {"linestyle": "-"}), ("right", {"linestyle": (0, (5, 1.5))}))
    sides = [(f"{sensor}_{side}", line) for side, line in lines if f"{sensor}_{side}" in result.table]
    return sides or [(sensor, {})]


def sensor_forces(result):
    """P and the sum of the sensors; each sensor; their difference, where it is a force.

    Over x, forward and backward; with inertia over time, with a look at the first reversal.
    """
    unit = result.units["P"]
    difference = result.table["sensor_sum"] - result.table["P"]
    apart = is_signal(difference, result.table["P"])
    figure, panels = draw_views(result, draw_column, 135 if apart else 104, (3, 3, 2) if apart else (3, 3))
    for axes, text in zip(panels[:, 0], (f"force [{unit}]", f"each sensor [{unit}]", f"sum less $P$ [{unit}]")):
        axes.set_ylabel(text)
    handles, names = panels[0, 0].get_legend_handles_labels()
    more = panels[1, 0].get_legend_handles_labels()
    if not apart:
        handles.append(plt.Line2D([], [], linestyle=""))
        names.append(f"sum and $P$ agree within {np.nanmax(np.abs(difference)):.0e} {unit}")
    legend_on_top(figure, handles + more[0], names + more[1])
    figure.align_ylabels()
    return figure


def draw_views(result, draw_column, height, ratios):
    """A figure of that height [mm] with rows of panels, a column of them for each view of the result, and its panels."""
    columns = views(result)
    size = (TWO_COLUMNS, height * MILLIMETRE)
    figure, panels = plt.subplots(
        len(ratios), len(columns), sharex="col", sharey="row", squeeze=False, figsize=size, height_ratios=ratios
    )
    for index, (over, values, rows) in enumerate(columns):
        draw_column(panels[:, index], result, values, rows)
        panels[-1, index].set_xlabel(over)
        panels[-1, index].set_xlim(np.nanmin(values[rows]), np.nanmax(values[rows]))
    for axes, letter in zip(panels.flat, "abcdefgh"):
        panel_letter(axes, letter)
    return figure, panels


def views(result):
    """[(label, values, rows shown)], a column of panels each."""
    time, x = result.table["time"], result.table["x"]
    if not is_transient(result):
        steps = np.diff(x, prepend=x[0] - 1)
        ways = (("forward", steps > 0), ("backward", steps < 0))
        return [(f"$x$ [{result.units['x']}], {way}", x, rows) for way, rows in ways if rows.any()]
    found = [("$t$ [s]", time, np.ones(len(time), dtype=bool))]
    if has_reversal(result):
        since = time - reversal_time(result)
        near = (since >= -LEAD) & (since <= zoom_end(result))
        found.append(("$t$ from the turning point [ms]", 1e3 * since, near))
    return found


def draw_column(panels, result, over, rows):
    table = result.table
    for column, name, colour, line in PAIR:
        panels[0].plot(over[rows], table[column][rows], color=colour, linestyle=line, label=name, linewidth=0.9)
    for index, column in enumerate(sensor_columns(result)):
        own = {**look(index + 2), "linewidth": 0.9}
        for part, line in sensor_sides(result, column):
            panels[1].plot(over[rows], table[part][rows], label=part.replace("_", " "), **{**own, **line})
    if len(panels) > 2:
        panels[2].plot(over[rows], (table["sensor_sum"] - table["P"])[rows], color="black", linewidth=0.9)
    for axes in panels:
        axes.axhline(0, color="black", linewidth=0.5, zorder=1)
