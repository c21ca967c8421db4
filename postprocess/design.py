# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of designs: the lever, the front of two aims with the levers on it, and what judges found over what was expected."""

import sys

import numpy as np

from apparatus import found_lever, make_device
from device import drawing
from sprag.parameters import slug
from sprag.program import program
from sprag.results import NotAResult
from style import COLOURS, LINES, MARKERS, MILLIMETRE, ONE_COLUMN, TWO_COLUMNS, legend_on_top, panel_letter, parameter_label, plt


def design_pictures(result):
    pictures = {}
    if found_lever(result.folder):
        try:
            pictures["device"] = drawing(make_device(result.folder, program(), None))
        except NotAResult as error:  # as without the program
            print(f"plot.py: no picture of the lever: {error}", file=sys.stderr)
    if len(result.table["largest_violation"]) > 2:
        pictures["front"] = front(result)
    if "judgements" in result.groups:
        pictures["judgements"] = judgements(result)
    return pictures


def free_parameters(result):
    """Name, smallest and largest value of each, in the unit of its column."""
    free = result.groups.get("free", {"parameter": np.array([]), "from": [], "to": []})
    return list(zip(free["parameter"].astype(str), free["from"], free["to"]))


def aim(result, name):
    """Returns the quantity of the aim and its column."""
    quantity = result.parameter("Design", name).split(maxsplit=1)[1]
    return quantity, slug(quantity)


def aim_label(result, quantity, column):
    unit = result.units[column]
    return parameter_label(quantity, unit) if "/" in quantity else quantity + (f" [{unit}]" if unit != "1" else "")


def front(result):
    """One aim over the other, and where between their bounds the parameters of these levers are."""
    figure, (aims, levers) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 75 * MILLIMETRE))
    (first, first_column), (second, second_column) = aim(result, "Aim"), aim(result, "Second aim")
    # The first row is the lever that is found by the first aim alone.
    rows = {name: column[1:] for name, column in result.table.items()}
    order = np.argsort(rows[second_column])
    over = rows[second_column][order]
    aims.plot(over, rows[first_column][order], color=COLOURS[0], marker=MARKERS[0], markersize=3)
    aims.set_ylabel(aim_label(result, first, first_column))
    handles = []
    for index, (name, low, high) in enumerate(free_parameters(result)):
        share = 100 * (rows[slug(name)][order] - low) / (high - low)
        look = {"color": COLOURS[index % len(COLOURS)], "linestyle": LINES[index % len(LINES)], "marker": MARKERS[index % len(MARKERS)]}
        handles += levers.plot(over, share, markersize=3, label=parameter_label(name), **look)
    levers.set_ylabel("place between the bounds [%]")
    levers.set_ylim(-5, 105)
    for axes, letter in zip((aims, levers), "ab"):
        axes.set_xlabel(aim_label(result, second, second_column))
        panel_letter(axes, letter)
    legend_on_top(figure, handles, [handle.get_label() for handle in handles])
    return figure


def asked_quantities(result):
    """Names of the quantities that are demanded and known before a judge is asked."""
    names = []
    for part in result.parameter("Design", "Demands").split(";"):
        name = " ".join(part.replace("<", "=").replace(">", "=").split("=")[0].split())
        if f"expected_{slug(name)}" in result.groups["judgements"] and name not in names:
            names.append(name)
    return names


def judgements(result):
    """Draws the quantities that each judge found over the expected ones, lever after lever."""
    group = result.groups["judgements"]
    names = asked_quantities(result)
    judges = [f"{judge} {number:.0f}" for judge, number in zip(group["judge"].astype(str), group["round"])]
    figure, axes = plt.subplots(figsize=(max(ONE_COLUMN, 14 * MILLIMETRE * len(judges)), 75 * MILLIMETRE), squeeze=True)
    handles, labels, farthest = [], [], 1.0
    for index, name in enumerate(names):
        found, expected = group[slug(name)], group[f"expected_{slug(name)}"]
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where((found > 0) & (expected > 0), 100 * (found / expected - 1), np.nan)
        if not np.isfinite(ratio).any():
            continue
        look = {"color": COLOURS[index % len(COLOURS)], "marker": MARKERS[index % len(MARKERS)]}
        handles += axes.plot(np.arange(len(judges)), ratio, linewidth=0.6, markersize=4, **look)
        labels.append(name)
        farthest = max(farthest, np.nanmax(np.abs(ratio)))
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set_xticks(range(len(judges)), judges, rotation=45 if len(judges) > 3 else 0)
    axes.set_xlim(-0.5, len(judges) - 0.5)
    axes.set_yscale("symlog", linthresh=1)
    axes.set_ylim(-2 * farthest, 2 * farthest)
    axes.set_ylabel("judge above what was expected [%]")
    axes.set_xlabel("judge and round")
    legend_on_top(figure, handles, labels)
    return figure
