"""Pictures of studies: what the runs found over the parameters that were varied, and what their accuracy costs."""

from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from style import COLOURS, MARKERS, MILLIMETRE, TWO_COLUMNS, legend_on_top, look, panel_letter, plt

# What is drawn of each Study/Type, as far as its runs have it.
QUANTITIES = {
    "quasi-static": ("peak_P_forward", "peak_P_backward", "loop_area", "peak_Q_forward", "peak_Q_backward", "largest_pressure"),
    "transient": (
        "peak_P_forward",
        "peak_P_backward",
        "loop_area",
        "reversal_1_frequency",
        "reversal_1_growth_rate",
        "reversal_1_open_share",
    ),
    "modal": ("frequency_1", "frequency_2", "frequency_3", "frequency_4"),
    "stability": ("growth_rate", "frequency", "P", "margin"),
    "sprag slip": ("measured_growth_rate", "measured_frequency", "cycle_amplitude_P", "cycle_open_share"),
    "contact law": ("stiffness", "exponent", "rms_error"),
    "calibration": ("stiffness", "moment_of_inertia", "P_deviation", "Q_deviation"),
    "slope": ("critical_inclination",),
}
# Beyond them a bar tells colours apart.
MOST_LINES = 7
# Ends of an axis with this ratio want a logarithm.
WIDE = 15


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
        name = self.name.split("/")[1].lower()
        return name if self.unit == "1" else f"{name} [{self.unit.replace('mm^n', 'mm$^n$')}]"

    def said(self, text):
        return f"{self.name.split('/')[1].lower()} {text}" if self.is_number or text == "auto" else text


def is_study(result):
    return "outcome" in result.table and "run" in result.table


def slug(name):
    return "".join(c.lower() if c.isalnum() else "_" for c in name)


def varied_parameters(result):
    texts = result.groups["runs"]
    names = [part.split("=")[0].strip() for part in result.parameter("Study", "Vary").split(";") if "=" in part]
    return [
        Varied(name, result.units[slug(name)], result.table[slug(name)], texts[slug(name)].astype(str))
        for name in (" ".join(name.split()) for name in names)
    ]


def abscissa_of(varied):
    """The parameter that curves go over: of those with numbers the one with the most values."""
    return max(varied, key=lambda parameter: (parameter.is_number, len(np.unique(parameter.numbers))))


def families(result, others):
    """[(text, number of the only other parameter or None, mask)] in the order of the runs."""
    told = np.array([", ".join(p.said(p.texts[row]) for p in others) for row in range(len(result.table["run"]))], dtype=object)
    found = []
    for text in dict.fromkeys(told):
        mask = told == text
        single = others[0].numbers[mask][0] if len(others) == 1 and others[0].is_number else None
        found.append((text, single, mask))
    return found


def looks(found):
    """The line of each family; many by colour alone, from a scale."""
    if len(found) <= MOST_LINES:
        return [look(index) for index in range(len(found))], None
    numbers = np.array([index if number is None else number for index, (_, number, _) in enumerate(found)], dtype=float)
    wide = numbers.min() > 0 and numbers.max() / numbers.min() > WIDE
    norm = (plt.matplotlib.colors.LogNorm if wide else plt.Normalize)(numbers.min(), numbers.max())
    scale = plt.cm.ScalarMappable(norm, "viridis")
    return [{"color": scale.to_rgba(number)} for number in numbers], scale


def panels_for(count):
    columns = 3 if count in (3, 5, 6) else min(2, count)
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(TWO_COLUMNS, (14 + 50 * rows) * MILLIMETRE), squeeze=False)
    for unused in axes.flat[count:]:
        unused.set_visible(False)
    return figure, list(axes.flat[:count])


def quantities_of(result):
    wanted = QUANTITIES.get(result.parameter("Study", "Type"), ())
    return [name for name in wanted if result.has(name)]


def curves(result):
    """The numbers of the runs over a parameter, a line for each setting of the others."""
    varied = varied_parameters(result)
    abscissa = abscissa_of(varied)
    others = [parameter for parameter in varied if parameter is not abscissa]
    found = families(result, others)
    lines, scale = looks(found)
    names = quantities_of(result) or ["cpu_time"]
    figure, panels = panels_for(len(names))
    for axes, name, letter in zip(panels, names, "abcdef"):
        for (text, _, mask), line in zip(found, lines):
            x, y = abscissa.numbers[mask], result.table[name][mask]
            order = np.argsort(x, kind="stable")
            axes.plot(x[order], y[order], marker=".", markersize=3, label=text, **line)
        unit = result.units[name].replace("^2", "$^2$")
        axes.set_ylabel(name.replace("_", " ") + (f" [{unit}]" if unit not in ("", "1") else ""))
        axes.set_xlabel(abscissa.label)
        set_abscissa(axes, abscissa, abscissa.numbers[result.table["outcome"] == 0])
        panel_letter(axes, letter)
    if scale is not None:
        bar = figure.colorbar(scale, ax=panels, aspect=30, pad=0.01)
        bar.set_label(others[0].label if len(others) == 1 else "other settings")
    elif len(found) > 1:
        legend_on_top(figure, *panels[0].get_legend_handles_labels())
    return figure


def set_abscissa(axes, abscissa, shown):
    if not abscissa.is_number:
        axes.set_xticks(np.unique(abscissa.numbers), list(dict.fromkeys(abscissa.texts[np.argsort(abscissa.numbers)])))
    elif len(shown) and shown.min() > 0 and shown.max() / shown.min() > WIDE:
        axes.set_xscale("log")
        plain_logarithms(axes.xaxis)
    axes.ticklabel_format(axis="y", useOffset=False)


def plain_logarithms(axis):
    """1, 2, 5, 10 ... in place of powers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
    axis.set_minor_formatter(NullFormatter())


# Errors


def measures_of(result):
    return [name[len("error_") :] for name in result.table if name.startswith("error_")]


def has_trade(result):
    return any((result.table[f"error_{name}"] > 0).any() for name in measures_of(result))


def trade(result):
    """Error against CPU time with the front on which nobody cheaper is as exact; its runs are labelled."""
    varied = varied_parameters(result)
    sizes = abscissa_of(varied)
    others = [parameter for parameter in varied if parameter is not sizes]
    found = families(result, others)
    names = sorted(measures_of(result), key=lambda name: (name == "all", list(result.table).index(f"error_{name}")))
    figure, panels = panels_for(len(names))
    for axes, name, letter in zip(panels, names, "abcdef"):
        cost, error = result.table["cpu_time"], 100 * result.table[f"error_{name}"]
        shown = np.isfinite(error) & (error > 0)
        for index, (text, _, mask) in enumerate(found):
            style = {"marker": MARKERS[index % len(MARKERS)], "color": COLOURS[index % len(COLOURS)]}
            axes.plot(cost[mask & shown], error[mask & shown], linestyle="", markersize=3.5, label=text, **style)
        draw_front(axes, cost, error, shown & (result.table[f"pareto_{name}"] == 1), sizes)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.margins(0.12)
        plain_logarithms(axes.xaxis)
        plain_logarithms(axes.yaxis)
        axes.set_title(f"({letter}) {name.replace('_', ' ')}", loc="left", fontsize=8)
        axes.set_xlabel("CPU time [s]")
        axes.set_ylabel("error [%]")
    handles, labels = panels[0].get_legend_handles_labels()
    handles.append(plt.Line2D([], [], color="black", linewidth=0.8))
    legend_on_top(figure, handles, [*(text or "runs" for text in labels), f"front, labels: {sizes.label}"])
    return figure


def draw_front(axes, cost, error, front, sizes):
    order = np.flatnonzero(front)[np.argsort(cost[front])]
    axes.plot(cost[order], error[order], color="black", linewidth=0.8, zorder=1)
    for row in order:
        axes.annotate(sizes.texts[row], (cost[row], error[row]), xytext=(3, 3), textcoords="offset points", fontsize=6)


def study_pictures(result):
    return {"study": curves(result), **({"trade": trade(result)} if has_trade(result) else {})}
