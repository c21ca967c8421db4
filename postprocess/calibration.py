# SPDX-License-Identifier: GPL-3.0-only
"""A calibrated beam beside the meshed lever it was calibrated by."""

import numpy as np

from style import COLOURS, MILLIMETRE, TWO_COLUMNS, panel_letter, plt

CURVES = (("", "meshed lever", COLOURS[0], "-"), ("_beam", "calibrated beam", COLOURS[1], (0, (5, 1.5))))
WAYS = {1: (">", "forward"), -1: ("<", "backward")}
STATES = (("free_frequency_", "free"), ("contact_frequency_", "contact"))


def calibration(result):
    """P and Q of both over x; frequencies of both, with what the beam is off."""
    figure = plt.figure(figsize=(TWO_COLUMNS, 130 * MILLIMETRE))
    grid = figure.add_gridspec(2, 2)
    panels = [figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, :])]
    for axes, column in zip(panels, "PQ"):
        draw_force(axes, result, column)
    draw_frequencies(panels[2], result.summary)
    for axes, letter in zip(panels, "abc"):
        panel_letter(axes, letter)
    panels[0].legend()
    ways = [plt.Line2D([], [], color="black", linestyle="", marker=marker, markersize=3) for marker, _ in WAYS.values()]
    panels[1].legend(ways, [name for _, name in WAYS.values()])
    figure.suptitle(constants(result), fontsize=7)
    return figure


def constants(result):
    """Returns the calibrated constants as a text."""
    entries = (("stiffness", "$k$"), ("moment_of_inertia", "$J$"), ("bending_stiffness", "$EI$"), ("contact_stiffness", "$k_c$"),
               ("contact_exponent", "exponent"))  # fmt: skip
    return ", ".join(
        f"{symbol} = {result.summary[name]:.5g}{unit(result.summary[name].unit)}"
        for name, symbol in entries
        if name in result.summary
    )


def unit(text):
    return "" if text in ("", "1") else " " + text.replace("^2", "²").replace("^n", "ⁿ")


def draw_force(axes, result, column):
    table = result.table
    for way, (marker, _) in WAYS.items():
        rows = np.flatnonzero(table["direction"] == way)
        rows = rows[np.argsort(table["x"][rows])]
        for ending, name, colour, line in CURVES:
            style = {"color": colour, "linestyle": line, "marker": marker, "markersize": 3}
            axes.plot(table["x"][rows], table[column + ending][rows], label=name if way == 1 else None, **style)
    axes.axhline(0, color="black", linewidth=0.5)
    axes.set_xlabel("$x$ [mm]")
    axes.set_ylabel(f"${column}$ [{result.units[column]}]")
    deviation = result.summary.get(f"{column}_deviation")
    if deviation is not None:
        axes.set_title(f"deviation {percent(deviation)} of the peak", loc="right", fontsize=7)


def percent(share):
    return f"{100 * share:.2g} %"


def frequencies(summary):
    """[(name, of the mesh, of the beam, deviation)], free ones first."""
    found = []
    for prefix, state in STATES:
        number = 1
        while f"{prefix}{number}_beam" in summary:
            entry = f"{prefix}{number}"
            found.append((f"{state} {number}", summary[entry], summary[f"{entry}_beam"], summary[f"{entry}_deviation"]))
            number += 1
    return found


def draw_frequencies(axes, summary):
    """Bars side by side on a logarithmic axis, the deviation on top."""
    found = frequencies(summary)
    axes.set_ylabel("frequency [Hz]")
    axes.grid(axis="x", visible=False)
    if not found:
        axes.annotate("no frequencies", (0.5, 0.5), xycoords="axes fraction", ha="center")
        return
    places = np.arange(len(found))
    highest = max(max(mesh, beam) for _, mesh, beam, _ in found)
    lowest = min(min(mesh, beam) for _, mesh, beam, _ in found)
    for index, (_, name, colour, _) in enumerate(CURVES):
        axes.bar(places + (index - 0.5) * 0.38, [entry[1 + index] for entry in found], 0.38, color=colour, label=name)
    for place, (_, mesh, beam, deviation) in enumerate(found):
        axes.annotate(f"{mesh:.4g} Hz\n{beam:.4g} Hz\n{100 * deviation:+.2g} %", (place, max(mesh, beam)), xytext=(0, 2),
                      textcoords="offset points", ha="center", fontsize=6)  # fmt: skip
    axes.set_yscale("log")
    bottom = 10 ** np.floor(np.log10(0.7 * lowest))
    axes.set_ylim(bottom, highest * (highest / bottom) ** 0.35)  # room for the numbers
    axes.set_xticks(places, [entry[0] for entry in found])
    axes.legend(loc="upper left")
