# SPDX-License-Identifier: GPL-3.0-only
"""Several results in one picture where they are no runs along a drive, and what any results have in common: their numbers."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from map import boundary_lines, read_map
from several import distinguish, headlines_in_common
from sprag.results import NotAResult
from style import MILLIMETRE, TWO_COLUMNS, WIDE, folded, in_maths, is_signal, label, panel_letter, parameter_label, plt
from vibration import scale_eigenvalues
from study import MOST_PANELS, choose_abscissa, find_quantities, panels_for, varied_parameters

# Columns over columns, of results of one type.
CURVES = {
    "isolation": (("time", "z"), ("time", "table_acceleration"), ("z", "damper_force")),
    "contact law": (("local", "P"),),
    "calibration": (("x", "P"), ("x", "Q")),
    "slope": (("mu", "dimensionless_forward"), ("mu", "dimensionless_backward"), ("theta0", "dimensionless_forward"), ("theta0", "dimensionless_backward")),
}
THIN = {"linewidth": 0.6}


def overlays(results):
    """{picture name: figure} of results of any types. Throws NotAResult where they have nothing in common."""
    types = {result.type for result in results}
    kind = types.pop() if len(types) == 1 else None
    pictures = {}
    if kind == "map":
        pictures["map"] = boundaries(results)
    elif kind == "study":
        pictures["study"] = studies(results)
    elif kind in ("modal", "stability"):
        pictures["modes"] = eigenvalues(results)
    elif kind in CURVES:
        pictures["curves"] = curves(results, CURVES[kind])
    shown, differing = numbers_in_common(results)
    if kind != "study" and (shown := differing or (shown if not any(pictures.values()) else [])):
        pictures["numbers"] = numbers(results, shown)
    if not any(pictures.values()):
        raise NotAResult(f"{', '.join(result.name for result in results)}: of types {', '.join(sorted({r.type for r in results}))}, which have nothing in common")
    return {name: figure for name, figure in pictures.items() if figure}


def curves(results, pairs):
    """A column over another in each panel, a line a result; it is broken where the abscissa begins anew."""
    several = distinguish(results)
    shown = [pair for pair in pairs if all(result.has(column) for result in results for column in pair)]
    if not shown:
        return None
    figure, panels = panels_for(len(shown))
    for axes, (over, column), letter in zip(panels, shown, "abcdef"):
        for result, name, look in zip(results, several.names, several.looks):
            dense = THIN if len(result.table[over]) > 1000 else {}
            axes.plot(*broken(np.asarray(result.table[over]), np.asarray(result.table[column])), label=name, **{**look, **dense})
        axes.set_xlabel(label(results[0].units, over))
        axes.set_ylabel(label(results[0].units, column))
        panel_letter(axes, letter)
    several.explain(figure, panels, panels[-1])
    return figure


def broken(x, y):
    """With a gap where x falls back by more than half of its range."""
    ends = np.flatnonzero(np.diff(x) < -0.5 * np.ptp(x)) + 1
    return np.insert(x, ends, np.nan), np.insert(y, ends, np.nan)


def eigenvalues(results):
    """Growth rate and frequency of the lowest modes; of undamped ones the frequency alone. None where all jam."""
    several, modes = distinguish(results), [result.groups["modes"] for result in results]
    rates, frequencies = (np.concatenate([group[name] for group in modes]) for name in ("growth_rate", "frequency"))
    if len(rates) == 0:
        return None
    grow = is_signal(rates, frequencies)
    figure, axes = plt.subplots(figsize=(TWO_COLUMNS, 75 * MILLIMETRE))
    for index, (group, name, look) in enumerate(zip(modes, several.names, several.looks)):
        across = group["growth_rate"] if grow else np.arange(1, len(group["frequency"]) + 1)
        size = 7 - 4 * index / len(results)
        axes.plot(across, group["frequency"], "o", label=name, color=look["color"], markersize=size, fillstyle="none")
    if grow:
        scale_eigenvalues(axes, rates, frequencies)
    else:
        axes.set_yscale("log")
        axes.set_xlabel("number of the mode")
        axes.set_ylabel("frequency [Hz]")
    several.explain(figure, [axes], axes)
    return figure


def studies(results):
    """The quantities of studies over the parameter that they share; None where there is none."""
    several = distinguish(results)
    varied = [varied_parameters(result) for result in results]
    abscissae = [choose_abscissa(parameters) for parameters in varied]
    names = [name for name in find_quantities(results[0]) if all(result.has(name) for result in results)]
    if len({abscissa.name for abscissa in abscissae}) > 1 or not all(abscissa.is_number for abscissa in abscissae) or not names:
        return None
    figure, panels = panels_for(len(names))
    for axes, quantity, letter in zip(panels, names, "abcdef"):
        for result, parameters, abscissa, name, look in zip(results, varied, abscissae, several.names, several.looks):
            others = [parameter for parameter in parameters if parameter is not abscissa]
            settings = np.array([" ".join(other.texts[row] for other in others) for row in range(len(abscissa.numbers))])
            for index, setting in enumerate(dict.fromkeys(settings)):
                rows = np.flatnonzero(settings == setting)
                rows = rows[np.argsort(abscissa.numbers[rows], kind="stable")]
                line = {"label": None if index else name, **look}
                axes.plot(abscissa.numbers[rows], result.table[quantity][rows], marker=".", markersize=3, **line)
        axes.set_xlabel(folded(abscissae[0].label))
        axes.set_ylabel(folded(with_brackets(quantity.replace("_", " "), results[0].units[quantity])))
        panel_letter(axes, letter)
    several.explain(figure, panels, panels[-1])
    return figure


def boundaries(results):
    """The boundaries of maps over the same two parameters, forward and backward; None over others."""
    several, charts = distinguish(results), [read_map(result) for result in results]
    if len({chart.names for chart in charts}) > 1:
        return None
    figure, panels = plt.subplots(1, 2, sharex=True, sharey=True, figsize=(TWO_COLUMNS, 82 * MILLIMETRE))
    for axes, way, direction, letter in zip(panels, ("forward", "backward"), (1, -1), "ab"):
        for result, chart, name, look in zip(results, charts, several.names, several.looks):
            lines = [line for lines in boundary_lines(result, chart, direction).values() for line in lines]
            points = np.concatenate([np.append(np.transpose(line), [[np.nan, np.nan]], axis=0) for line in lines]) if lines else np.full((1, 2), np.nan)
            axes.plot(*points.T, label=name, **look)
        if not any(np.isfinite(line.get_xdata()).any() for line in axes.lines):
            axes.annotate("one kind alone", (0.5, 0.5), xycoords="axes fraction", ha="center")
        axes.set_xlabel(parameter_label(charts[0].names[0], charts[0].units[0]))
        axes.set_title(f"({letter}) boundaries, {way}", loc="left", fontsize=8)
    panels[0].set_xlim(*sorted((charts[0].values["first"].min(), charts[0].values["first"].max())))
    panels[0].set_ylabel(r"inclination $\theta_0$ [deg]" if charts[0].theta_is_ordinate else parameter_label(charts[0].names[1], charts[0].units[1]))
    several.explain(figure, panels, panels[1])
    return figure


# Numbers


def numbers_in_common(results):
    """Names of headlines that all have, and those of them that differ."""
    names = headlines_in_common(results)
    differing = [name for name in names if len({float(f"{round(result.summary[name], 6):.6g}") for result in results}) > 1]
    return names[:MOST_PANELS], differing[:MOST_PANELS]


def numbers(results, names):
    """A panel for each, over the parameter that differs where it is a number, else over the names of the results."""
    several = distinguish(results)
    figure, panels = panels_for(len(names))
    for axes, name, letter in zip(panels, names, "abcdef"):
        draw_number(axes, results, several, name)
        panel_letter(axes, letter)
    return figure


def draw_number(axes, results, several, name):
    """Draws a number over the parameter, or beside the names of the results if the parameter is no number or repeats."""
    found, places = np.array([float(result.summary[name]) for result in results]), several.values
    text, colours = folded(with_brackets(name.replace("_", " "), results[0].summary[name].unit)), [look["color"] for look in several.looks]
    if places is None or len(np.unique(places)) < len(places):
        axes.scatter(found, range(len(found)), color=colours, s=16)
        axes.set_yticks(range(len(found)), several.names if axes.get_subplotspec().is_first_col() else [""] * len(found))
        axes.set_ylim(len(found) - 0.5, -0.5)
        axes.set_xlabel(text)
        axes.xaxis.set_major_locator(MaxNLocator(3))
        axes.xaxis.set_major_formatter("{x:g}")
        return
    order = np.argsort(places, kind="stable")
    axes.plot(places[order], found[order], color="0.6", linewidth=0.8, zorder=1)
    axes.scatter(places, found, color=colours, s=16)
    axes.set_xlabel(folded(several.label + several.remark))
    if places.min() > 0 and places.max() / places.min() > WIDE:
        axes.set_xscale("log")
    axes.set_ylabel(text)
    axes.ticklabel_format(axis="y", useOffset=False)


def with_brackets(text, unit):
    return text if unit in ("", "1") else f"{text} [{in_maths(unit)}]"
