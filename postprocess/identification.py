# SPDX-License-Identifier: GPL-3.0-only
"""A lever identified from a measured stroke: what was measured beside it, what it leaves over, and how its numbers hang together."""

import numpy as np

from style import COLOURS, LINES, MILLIMETRE, TWO_COLUMNS, panel_letter, plt

LETTERS = "abcdefgh"
FARTHEST = 40  # rows of the autocorrelation
NAMES = {"mu": r"$\mu$", "k": "$k$", "e": "$e$", "th0": r"$\theta_0$", "lag": "lag", "friction_factor": "factor"}


def measured_forces(result):
    return [name.removesuffix("_fitted") for name in ("P_fitted", "Q_fitted", "sensors_fitted") if name in result.table]


def identification(result):
    """A row of panels for each force, below them the autocorrelation of what is left and the correlation of the unknowns."""
    forces = measured_forces(result)
    rows = len(forces) + 1
    figure = plt.figure(figsize=(TWO_COLUMNS, (52 * rows + 4) * MILLIMETRE))
    panels = figure.subplots(rows, 2)
    for (left, right), force in zip(panels, forces):
        draw_force(left, result, force)
        draw_residual(right, result, force)
    panels[0, 0].legend()
    panels[0, 1].legend(loc="upper right", ncol=2)
    draw_autocorrelation(panels[-1, 0], result, forces)
    draw_correlation(panels[-1, 1], result.groups["identification"])
    for axes, letter in zip(panels.flat, LETTERS):
        panel_letter(axes, letter)
    return figure


def ways(result):
    """Rows that count, by direction."""
    used = result.table["used"] > 0
    return {1: used & (result.table["direction"] > 0), -1: used & (result.table["direction"] < 0)}


def draw_force(axes, result, force):
    table = result.table
    out = table["used"] == 0
    axes.plot(table["x"][out], table[force][out], ".", color="0.6", markersize=2, label="left out")
    used = ~out
    axes.plot(table["x"][used], table[force][used], ".", color=COLOURS[5], markersize=2, label="measured")
    for way, rows in ways(result).items():
        order = np.flatnonzero(rows)[np.argsort(table["x"][rows])]
        label = "lever found, forward" if way > 0 else "lever found, backward"
        style = {"color": COLOURS[0 if way > 0 else 1], "linestyle": LINES[0 if way > 0 else 1]}
        axes.plot(table["x"][order], table[f"{force}_fitted"][order], label=label, **style)
    axes.set_xlabel("$x$ [mm]")
    axes.set_ylabel(force_label(force))


def force_label(force, what=""):
    return f"{what}sensors [N]" if force == "sensors" else f"{what}${force}$ [N]"


def draw_residual(axes, result, force):
    table = result.table
    for way, rows in ways(result).items():
        style = {"color": COLOURS[0 if way > 0 else 1], "marker": ">" if way > 0 else "<", "markersize": 1.8, "linestyle": ""}
        axes.plot(table["x"][rows], table[f"{force}_residual"][rows], label="forward" if way > 0 else "backward", **style)
    noise = result.summary[f"noise_{force}"]
    for side in (-2, 2):
        axes.axhline(side * noise, color="black", linewidth=0.6, linestyle=(0, (4, 3)))
    left = np.abs(table[f"{force}_residual"][table["used"] > 0])
    axes.set_ylim(*(1.7 * max(left.max(), 2 * noise) * np.array((-1, 1))))
    axes.set_xlabel("$x$ [mm]")
    axes.set_ylabel(force_label(force, "measured less fitted "))


def autocorrelation(result, force):
    """Returns the autocorrelation of the residual within strokes one way."""
    residual = result.table[f"{force}_residual"]
    products, squares = np.zeros(FARTHEST + 1), 0.0
    for rows in ways(result).values():
        part = residual[rows & np.isfinite(residual)]
        squares += part @ part
        for distance in range(min(FARTHEST + 1, len(part))):
            products[distance] += part[: len(part) - distance] @ part[distance:]
    return products / squares if squares > 0 else products


def draw_autocorrelation(axes, result, forces):
    for index, force in enumerate(forces):
        effective = result.summary[f"effective_values_{force}"]
        label = f"{force}: {result.summary[f'values_{force}']:.0f} values worth {effective:.0f}"
        axes.plot(autocorrelation(result, force), color=COLOURS[index], linestyle=LINES[index], label=label)
    band = 2 / np.sqrt(result.summary[f"values_{forces[0]}"])
    axes.axhspan(-band, band, color="0.9", zorder=0)
    axes.set_ylim(None, 1.45)
    axes.set_xlabel("rows apart")
    axes.set_ylabel("autocorrelation of what is left")
    axes.legend(loc="upper right")


def draw_correlation(axes, group):
    names = [name.decode() if isinstance(name, bytes) else str(name) for name in group["names"]]
    matrix = np.asarray(group["correlation"])
    axes.imshow(matrix, cmap="RdBu_r", vmin=-1, vmax=1)
    axes.grid(False)
    words = [NAMES.get(name, name.replace("_", " ")) for name in names]
    axes.set_xticks(range(len(names)), words, rotation=0 if len(names) < 5 else 60)
    axes.set_yticks(range(len(names)), words)
    for (row, column), value in np.ndenumerate(matrix):
        colour = "white" if abs(value) > 0.6 else "black"
        text = f"{value:.3f}" if 0.99 < abs(value) < 0.9995 else f"{value:.2f}"
        axes.annotate(text, (column, row), ha="center", va="center", fontsize=6 if len(names) < 7 else 4.5, color=colour)
    axes.set_ylabel("correlation of the unknowns")
