"""What the two levers of a full mirrored pair do beside each other."""

from sensors import draw_views
from style import COLOURS, LINES, legend_on_top

LEVERS = (("", "first lever"), ("_2", "second lever"))
CLOSED_FORM = {"color": "black", "linestyle": (0, (1, 2)), "linewidth": 0.8, "zorder": 3, "label": "closed form of the first"}
FORCES = (("P", "$P$"), ("F", "$F$"))
BOTH = (("swing", "swing"), ("lateral_force", "lateral force"))


def has_pair(result):
    return all(result.has(column) for column in ("P", "P_2", "swing", "lateral_force"))


def pair_of_levers(result):
    """P and F of both levers, their swing and their force on the cylinder across its path.

    Over x, forward and backward; with inertia over time, with a look at the first reversal.
    """
    figure, panels = draw_views(result, draw_column, 150, (3, 3, 2, 2))
    for axes, (column, symbol) in zip(panels[:, 0], FORCES + BOTH):
        axes.set_ylabel(f"{symbol} [{result.units[column]}]")
    legend_on_top(figure, *panels[0, 0].get_legend_handles_labels())
    figure.align_ylabels()
    return figure


def draw_column(panels, result, values, rows):
    table = result.table
    across = values[rows]
    for axes, (column, _) in zip(panels, FORCES):
        for index, (suffix, name) in enumerate(LEVERS):
            line = {"color": COLOURS[index], "linestyle": LINES[index], "linewidth": 0.9}
            axes.plot(across, table[column + suffix][rows], label=name, **line)
    if result.has("P_closed_form"):
        panels[0].plot(across, table["P_closed_form"][rows], **CLOSED_FORM)
    for axes, (column, _) in zip(panels[len(FORCES) :], BOTH):
        axes.plot(across, table[column][rows], color="black", linewidth=0.9)
    for axes in panels:
        axes.axhline(0, color="black", linewidth=0.5, zorder=1)
