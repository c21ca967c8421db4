# SPDX-License-Identifier: GPL-3.0-only
"""Names several results by their differences: labels at the ends of the curves, a scale of colours or a legend."""

from dataclasses import dataclass
from typing import Optional

import numpy as np
from matplotlib import colormaps

from sprag.parameters import differing, parse
from sprag.results import NotAResult
from style import LINES, legend_on_top, look, make_scale, parameter_label, with_unit

MOST_RESULTS = 20
MOST_NAMED = 3  # parameters that differ; where there are more, folders name the results
MOST_LABELS = 5  # at the ends of curves; more are told apart by a scale or a legend
FEW_NUMBERS = 3  # of a scale
# These sections describe the method, not the device.
NUMERICAL = ("Analysis", "Mesh", "Contact", "Time", "Condensed", "Accuracy", "Beam")


@dataclass
class Several:
    """Holds the name and the look of each result."""

    parameter: Optional[str]  # Section/Name of what differs
    label: str  # of that parameter with its unit
    others: int  # parameters that differ as well
    values: Optional[np.ndarray]  # numbers of the parameter, where it is one
    names: list
    looks: list
    is_numerical: bool  # the runs differ in method alone, so that they have the same exact answer
    scale: object = None  # of colours, instead of names

    @property
    def remark(self):
        return f" ({self.others} more differ)" if self.others else ""

    def explain(self, figure, panels, beside, further=()):
        """Says which curve is which: at the right of the panel `beside`, or for all panels. `further`: handles and names more."""
        handles, names = [list(part) for part in zip(*further)] if further else ([], [])
        if self.scale is not None:
            figure.colorbar(self.scale, ax=list(panels), aspect=30, pad=0.01).set_label(self.label + self.remark)
        elif len(self.names) <= MOST_LABELS:
            label_ends(beside, [line for line in beside.lines if line.get_label() in self.names])
            if self.label:
                beside.set_title(self.label + self.remark, loc="right", y=1.07, fontsize=7)  # above the panel's letter
        else:
            lines = {line.get_label(): line for line in beside.lines}
            handles = [lines[name] for name in self.names if name in lines] + handles
            names = [name for name in self.names if name in lines] + names
        legend_on_top(figure, handles, names)


def distinguish(results):
    """Throws NotAResult where there are too many."""
    if len(results) > MOST_RESULTS:
        raise NotAResult(f"{len(results)} results: one picture tells up to {MOST_RESULTS} apart; a study compares more")
    listings = [parse(result.parameters) for result in results]
    different, looks = differing(listings), choose_looks(len(results))
    numerical = all(name.split("/")[0] in NUMERICAL for name in different)
    if not different or len(different) > MOST_NAMED:
        return Several(None, "", 0, None, unique([result.name for result in results], results), looks, numerical)
    name = chosen(listings)
    found = [parameters.get(name) for parameters in listings]
    unit = next(parameter.unit for parameter in found if parameter)
    label, others = parameter_label(name, unit), len(different) - 1
    texts = [said(parameter) for parameter in found]
    has_words = any(parameters.get(each) and parameters[each].number is None for parameters in listings for each in different)
    if others and (has_words or len(set(texts)) < len(texts)):
        say = said_with_words if has_words else said_together
        texts = [say([parameters.get(each) for each in different]) for parameters in listings]
        return Several(name, ", ".join(map(parameter_label, different)), 0, None, unique(texts, results), looks, numerical)
    if not all(parameter and parameter.number is not None for parameter in found):
        return Several(name, label, others, None, unique(texts, results), looks, numerical)
    values, names = np.array([parameter.number for parameter in found]), unique(texts, results)
    if len(results) <= MOST_LABELS or len(np.unique(values)) < FEW_NUMBERS:
        return Several(name, label, others, values, names, looks, numerical)
    scale = make_scale(values)
    return Several(name, label, others, values, names, [{"color": scale.to_rgba(value)} for value in values], numerical, scale)


def headlines_in_common(results):
    """Names of headlines that all results have."""
    return [name for name in results[0].headlines if all(name in result.headlines for result in results)]


def said(parameter):
    """A value with its unit; "default" where a result does not know the parameter."""
    if parameter is None:
        return "default"
    return parameter.file or parameter.text if parameter.number is None else with_unit(f"{parameter.number:g}", parameter.unit)


def said_together(parameters):
    return ", ".join(map(said, parameters))


def said_with_words(parameters):
    """Words, and numbers that are no defaults: those of dampers that are not used are."""
    set_apart = [each for each in parameters if each and (each.number is None or each.default is not None)]
    return said_together(set_apart or parameters)


def chosen(listings):
    """Returns the parameter with the most values as Section/Name, or None without a difference. Parameters of the device come
    before those of the method, numbers before words."""

    def rank(name):
        found = [parameters.get(name) for parameters in listings]
        different = len({parameter and parameter.text for parameter in found})
        numbers = all(parameter and parameter.number is not None for parameter in found)
        return different, name.split("/")[0] not in NUMERICAL, numbers

    return max(differing(listings), key=rank, default=None)


def unique(texts, results):
    """Adds names or folders to texts that results share."""
    named = [text if texts.count(text) == 1 else f"{text} ({result.name})" if text != result.name else text for text, result in zip(texts, results)]
    return [text if named.count(text) == 1 else f"{text} ({result.folder})" for text, result in zip(named, results)]


def choose_looks(count):
    """Curves that words tell apart: seven looks by heart, beyond them as many colours as there are. The first ones are drawn below the
    others and are wider, so that they show where they are hidden."""
    if count <= len(LINES):
        return [{**look(index), "linewidth": 1.0 + 1.4 * (count - 1 - index) / max(count - 1, 1)} for index in range(count)]
    colours = colormaps["tab20"]
    return [{"color": colours(index % 20), "linestyle": LINES[index % 2]} for index in range(count)]


# Labels at the ends of curves


def label_ends(axes, lines, height=0.085):
    """The name of each line right of the panel, at the height of its last point or beside its neighbours; once limits are set.

    `height`: of a line of text, over the panel's.
    """
    ends = [(line, end) for line in lines if (end := last_point(axes, line)) is not None]
    heights = [axes.transAxes.inverted().transform(axes.transData.transform(end))[1] for _, end in ends]
    for (line, end), place in zip(ends, spread(heights, height)):
        arrow = {"arrowstyle": "-", "color": line.get_color(), "linewidth": 0.5, "shrinkA": 0, "shrinkB": 1, "relpos": (0, 0.5)}
        style = {"color": line.get_color(), "fontsize": 7, "va": "center", "annotation_clip": False}
        axes.annotate(line.get_label(), end, xytext=(1.03, place), textcoords="axes fraction", arrowprops=arrow, **style)


def last_point(axes, line):
    """Returns the last point near the right end of the panel, at which a loop over x turns back."""
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    (left, right), (low, high) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    inside = np.flatnonzero((x >= left) & (x <= right) & (y >= low) & (y <= high))
    if len(inside) == 0:
        return None
    last = inside[x[inside] >= x[inside].max() - 0.01 * (right - left)][-1]
    return x[last], y[last]


def spread(heights, apart):
    """Places between 0 and 1 near the wanted ones, at least that far from one another, in their order."""
    order = np.argsort(heights, kind="stable")
    places = np.clip(np.asarray(heights, dtype=float)[order], 0, 1)
    for _ in range(200):
        for i in range(1, len(places)):
            overlap = apart - (places[i] - places[i - 1])
            if overlap > 0:
                places[i - 1] -= overlap / 2
                places[i] += overlap / 2
        if len(places) and (len(places) - 1) * apart <= 1:
            places += max(0, -places[0]) - max(0, places[-1] - 1)
    found = np.empty(len(places))
    found[order] = places
    return found
