# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of studies: what the runs found over the parameters that were varied, how errors fall, and what their accuracy costs."""

from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from sprag.parameters import slug
from style import COLOURS, LINES, MARKERS, MILLIMETRE, TWO_COLUMNS, WIDE, folded, legend_on_top, make_scale, panel_letter, parameter_label, plt

MOST_PANELS = 6
# Beyond them a bar tells colours apart.
MOST_LINES = 7
MOST_MARKED = 30  # points of a curve; marks of more hide how its line is broken


@dataclass
class Varied:
    """A parameter of a study: of each run its number, or its place among the words, and its text."""

    name: str
    unit: str
    numbers: np.ndarray
    texts: np.ndarray

    @property
    def is_number(self):
        try:
            return bool(np.isfinite(self.texts.astype(float)).all())
        except ValueError:
            return False

    @property
    def label(self):
        return parameter_label(self.name, self.unit)

    def said(self, text):
        return f"{parameter_label(self.name)} {text}" if self.is_number or text == "auto" else text


def varied_parameters(result):
    texts = result.groups["runs"]
    names = [part.split("=")[0].strip() for part in result.parameter("Study", "Vary").split(";") if "=" in part]
    return [
        Varied(name, result.units[slug(name)], result.table[slug(name)], texts[slug(name)].astype(str))
        for name in (" ".join(name.split()) for name in names)
    ]


def choose_abscissa(varied):
    """The parameter that curves go over: of those with numbers the one with the most values."""
    return max(varied, key=lambda parameter: (parameter.is_number, len(np.unique(parameter.numbers))))


@dataclass
class Code:
    """Holds the look of runs with the same other settings."""

    mask: np.ndarray
    colour: object
    line: object
    marker: str
    width: float = 1.2


def codes(result, others):
    """The codes of all settings of the other parameters, handles and names for a legend, and the scale of colours if there is one:
    colours by the parameter with the most values, lines and markers by the rest."""
    rows = len(result.table["run"])
    if not others:
        return [Code(np.ones(rows, dtype=bool), COLOURS[0], LINES[0], MARKERS[0])], ([], []), None
    coloured = max(others, key=lambda parameter: len(np.unique(parameter.texts)))
    rest = [parameter for parameter in others if parameter is not coloured]
    shades, scale = make_shades(coloured)
    styles = list(dict.fromkeys(row_settings(rest, row) for row in range(rows)))
    found = []
    for text in dict.fromkeys(coloured.texts):
        for index, style in enumerate(styles):
            mask = np.array([coloured.texts[row] == text and row_settings(rest, row) == style for row in range(rows)])
            if mask.any():
                shape = {"line": LINES[index % len(LINES)], "marker": MARKERS[index % len(MARKERS)]}
                found.append(Code(mask, shades[text], **shape))
    handles, names = [], []
    if scale is None:
        lines = [LINES[0 if rest else index % len(LINES)] for index in range(len(shades))]
        if not rest:  # lines are free to tell apart curves that hide each other
            for index, code in enumerate(found):
                code.line, code.width = lines[index], 1.0 + 1.4 * (len(found) - 1 - index) / len(found)
        handles += [plt.Line2D([], [], color=colour, linestyle=line) for colour, line in zip(shades.values(), lines)]
        names += [coloured.said(text) for text in shades]
    if rest:
        looks = zip(LINES * (1 + len(styles) // len(LINES)), MARKERS * (1 + len(styles) // len(MARKERS)), styles)
        handles += [plt.Line2D([], [], color="black", linestyle=line, marker=marker, markersize=3.5) for line, marker, _ in looks]
        names += styles
    return found, (handles, names), scale and (scale, coloured.label)


def row_settings(parameters, row):
    return ", ".join(parameter.said(parameter.texts[row]) for parameter in parameters)


def make_shades(parameter):
    """Colour of each text; of many from a scale."""
    texts = list(dict.fromkeys(parameter.texts))
    if len(texts) <= MOST_LINES or not parameter.is_number:
        return {text: COLOURS[index % len(COLOURS)] for index, text in enumerate(texts)}, None
    numbers = {text: number for text, number in zip(parameter.texts, parameter.numbers)}
    scale = make_scale(numbers.values())
    return {text: scale.to_rgba(numbers[text]) for text in texts}, scale


def panels_for(count):
    columns = 3 if count in (3, 5, 6) else min(2, count)
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(TWO_COLUMNS, (14 + 50 * rows) * MILLIMETRE), squeeze=False)
    for unused in axes.flat[count:]:
        unused.set_visible(False)
    return figure, list(axes.flat[:count])


def find_quantities(result):
    names = result.groups.get("headlines", {}).get("name", ())
    return [name for name in names if result.has(name)][:MOST_PANELS]


def curves(result):
    """The numbers of the runs over a parameter, a line for each setting of the others."""
    varied = varied_parameters(result)
    abscissa = choose_abscissa(varied)
    found, legend, bar = codes(result, [parameter for parameter in varied if parameter is not abscissa])
    names = find_quantities(result) or ["cpu_time"]
    figure, panels = panels_for(len(names))
    for axes, name, letter in zip(panels, names, "abcdef"):
        for code in found:
            x, y = abscissa.numbers[code.mask], result.table[name][code.mask]
            order = np.argsort(x, kind="stable")
            marks = {"marker": code.marker, "markersize": 2} if len(x) <= MOST_MARKED else {}
            axes.plot(x[order], y[order], color=code.colour, linestyle=code.line, linewidth=code.width, **marks)
        unit = result.units[name].replace("^2", "$^2$")
        axes.set_ylabel(folded(name.replace("_", " ") + (f" [{unit}]" if unit not in ("", "1") else "")))
        axes.set_xlabel(folded(abscissa.label))
        set_abscissa(axes, abscissa, abscissa.numbers[result.table["outcome"] == 0])
        panel_letter(axes, letter)
    explain(figure, panels, bar, *legend)
    return figure


def explain(figure, panels, bar, handles, labels):
    if bar is not None:
        figure.colorbar(bar[0], ax=panels, aspect=30, pad=0.01).set_label(bar[1])
    legend_on_top(figure, handles, labels)


def set_abscissa(axes, abscissa, shown):
    if not abscissa.is_number:
        texts = dict.fromkeys(abscissa.texts[np.argsort(abscissa.numbers)])
        axes.set_xticks(np.unique(abscissa.numbers), [text.replace(" ", "\n") for text in texts])
    elif len(shown) and shown.min() > 0 and shown.max() / shown.min() > WIDE:
        axes.set_xscale("log")
        plain_logarithms(axes.xaxis)
    axes.ticklabel_format(axis="y", useOffset=False)


def plain_logarithms(axis):
    """Numbers in place of powers: 1, 2, 5, 10 ... over less than two decades, round ones where not even two of these are in view."""
    low, high = axis.get_view_interval()
    few = MaxNLocator(3)
    axis.set_major_locator(few if high / low < 5 else LogLocator(subs=(1, 2, 5) if high / low < 60 else (1,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
    axis.set_minor_formatter(NullFormatter())


# Errors


def error_measures(result):
    return [name[len("error_") :] for name in result.table if name.startswith("error_")]


def has_trade(result):
    return any((result.table[f"error_{name}"] > 0).any() for name in error_measures(result))


def trade(result):
    """Error against the work that ranks runs, or CPU time, with the front on which nobody cheaper is as exact; its runs are labelled."""
    work = result.table.get("work", np.array([np.nan]))
    is_counted = np.isfinite(work).any()
    cost = work if is_counted else result.table["cpu_time"]
    varied = varied_parameters(result)
    sizes = choose_abscissa(varied)
    front = plt.Line2D([], [], color="black", linewidth=0.8)
    others = [parameter for parameter in varied if parameter is not sizes]
    names = sorted(error_measures(result), key=lambda name: name == "all")
    drawn = draw_errors(result, names, cost, "", others, [(front, f"front, labels: {sizes.label}")])
    for axes, name, error, shown in drawn:
        axes.margins(x=0.25, y=0.12)  # room for labels
        draw_front(axes, cost, error, shown & (result.table[f"pareto_{name}"] == 1), sizes)
        axes.set_xlabel("work, as CPU time [s]" if is_counted else "CPU time [s]")
    return drawn[0][0].figure


def observed_orders(result):
    """{measure: orders} of the size in which most of them are observed, of a mesh if there is one, and its name; {} and None without."""
    trade, by_size = result.groups.get("trade", {}), {}
    for text, order in zip(trade.get("order_of", ()), trade.get("order", ())):
        measure, _, size = str(text).split(";")[0].partition(" over ")
        by_size.setdefault(size, {}).setdefault(measure, []).append(order)
    size = max(by_size, key=lambda name: (name.startswith("Mesh/"), sum(map(len, by_size[name].values()))), default=None)
    return by_size.get(size, {}), size


def convergence(result):
    """Error against a size of elements or steps, with the order at which it falls."""
    orders, size = observed_orders(result)
    varied = varied_parameters(result)
    sizes = next(parameter for parameter in varied if parameter.name == size)
    others = [parameter for parameter in varied if parameter is not sizes]
    drawn = draw_errors(result, list(orders), sizes.numbers, "-", others)
    for axes, name, _, _ in drawn:
        least, most = (f"{order:.2g}" for order in (min(orders[name]), max(orders[name])))
        text = f"order {least}" if least == most else f"order {least} to {most}"
        axes.annotate(text, (0.97, 0.04), xycoords="axes fraction", ha="right", fontsize=7)
        axes.set_xlabel(folded(sizes.label))
    return drawn[0][0].figure


def draw_errors(result, names, over, line, others, further=()):
    """[(panel, measure, its errors [%], mask of those drawn)], a panel for each measure: errors against `over`, the runs of one setting
    of the others joined by `line`. `further`: handles and names more."""
    found, (handles, labels), bar = codes(result, others)
    figure, panels = panels_for(len(names))
    drawn = []
    for axes, name, letter in zip(panels, names, "abcdef"):
        error = 100 * result.table[f"error_{name}"]
        shown = np.isfinite(error) & (error > 0)
        for code in found:
            rows = np.flatnonzero(code.mask & shown)
            rows = rows[np.argsort(over[rows], kind="stable")]
            axes.plot(over[rows], error[rows], linestyle=line and code.line, marker=code.marker, color=code.colour, linewidth=0.8, markersize=3.5)
        axes.set_xscale("log")
        axes.set_yscale("log")
        plain_logarithms(axes.xaxis)
        plain_logarithms(axes.yaxis)
        axes.set_title(f"({letter}) {name.replace('_', ' ')}", loc="left", fontsize=8)
        axes.set_ylabel("error [%]")
        drawn.append((axes, name, error, shown))
    for handle in handles:
        marker = "s" if handle.get_marker() == "None" else handle.get_marker()
        handle.set(linestyle=line and handle.get_linestyle(), marker=marker, markersize=3.5)
    explain(figure, panels, bar, [*handles, *(handle for handle, _ in further)], [*labels, *(label for _, label in further)])
    return drawn


def draw_front(axes, cost, error, front, sizes):
    """Draws labels where there is room for them: no run lies left of the front and below it."""
    order = np.flatnonzero(front)[np.argsort(cost[front])]
    axes.plot(cost[order], error[order], color="black", linewidth=0.8, zorder=1)
    taken = []
    for row in order:
        place = axes.transAxes.inverted().transform(axes.transData.transform((cost[row], error[row])))
        if all(abs(place[0] - x) > 0.2 or abs(place[1] - y) > 0.09 for x, y in taken):
            axes.annotate(sizes.texts[row], (cost[row], error[row]), xytext=(-3, -2), textcoords="offset points", fontsize=6, ha="right", va="top")
            taken.append(place)


def study_pictures(result):
    pictures = {"study": curves(result)}
    if has_trade(result):
        pictures["trade"] = trade(result)
        if observed_orders(result)[1]:
            pictures["convergence"] = convergence(result)
    return pictures
