# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of stability maps: growth rate over two parameters, both directions of motion, with the boundaries found."""

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import SymLogNorm
from matplotlib.patches import Patch

from style import MILLIMETRE, TWO_COLUMNS, parameter_label, plt

KINDS = ("stable", "flutter", "divergence", "jammed", "inadmissible", "failed")
JAMMED, INADMISSIBLE, FAILED = 3, 4, 5
# Without growth rate: colour and hatching of each kind.
AREAS = {JAMMED: ("0.75", "////"), INADMISSIBLE: ("1", "...."), FAILED: ("0.9", "xxxx")}
# The style of a line between two kinds is that of the kind farther from stability.
LINES = {"flutter": "-", "divergence": (0, (5, 1.5)), "jammed": (0, (1.2, 1.2)), "inadmissible": ":", "failed": ":"}

# The cells that were judged; between them the map is interpolated.
JUDGED = {"color": "black", "markersize": 1.2, "alpha": 0.5, "markeredgewidth": 0}


@dataclass
class Map:
    names: tuple  # of the two parameters, Section/Name
    units: tuple
    values: dict  # dataset -> array

    @property
    def theta_is_ordinate(self):
        """Both parameters are lengths of the geometry: theta_0 says more than the second."""
        return all(name.startswith("Geometry/") for name in self.names)


def read_map(result):
    values = result.groups["map"]
    axes = [values[name] for name in ("first", "second")]
    return Map(tuple(axis.description for axis in axes), tuple(axis.unit for axis in axes), values)


# Boundaries


def segments(points, n_kinds=len(KINDS)):
    """Lines between boundary points on the sides of one quad of the grid, by the higher kind. `points`: columns first and
    second in intervals of the grid, along, kind_low, kind_high."""
    quads = {}
    for first, second, along, low, high in zip(*points):
        i, j = int(np.floor(first)), int(np.floor(second))
        beside = ((i, j), (i, j - 1)) if along == 1 else ((i, j), (i - 1, j))
        for quad in beside:
            quads.setdefault(quad, []).append((first, second, frozenset((low, high))))
    lines = {kind: [] for kind in range(n_kinds)}
    for crossing in quads.values():
        for kinds in {kinds for *_, kinds in crossing}:
            same = [(first, second) for first, second, between in crossing if between == kinds]
            if len(same) == 2:
                lines[int(max(kinds))].append(same)
        if len({kinds for *_, kinds in crossing}) > 1:
            # Three kinds meet: each line ends in the middle.
            middle = tuple(np.mean([point[:2] for point in crossing], axis=0))
            for first, second, kinds in crossing:
                if sum(between == kinds for *_, between in crossing) == 1:
                    lines[int(max(kinds))].append([(first, second), middle])
    return lines


def boundary_lines(result, chart, direction):
    """{kind: list of two points}, in the axes of the picture."""
    chosen = result.table["direction"] == direction
    index = [
        np.interp(result.table[name][chosen], *increasing(chart.values[name], np.arange(len(chart.values[name]), dtype=float)))
        for name in ("first", "second")
    ]
    columns = [result.table[name][chosen] for name in ("along", "kind_low", "kind_high")]
    return {kind: [on_axes(chart, line) for line in lines] for kind, lines in segments((*index, *columns)).items() if lines}


def increasing(x, y):
    return (x, y) if x[-1] > x[0] else (x[::-1], y[::-1])


def on_axes(chart, line):
    """Points in intervals of the grid to what the axes show."""
    first, second = np.array(line).T
    horizontal, vertical = positions(chart)
    return at(horizontal, first, second), at(vertical, first, second)


def at(values, first, second):
    """Bilinear."""
    i = np.minimum(first.astype(int), values.shape[0] - 2)
    j = np.minimum(second.astype(int), values.shape[1] - 2)
    s, t = first - i, second - j
    low = (1 - t) * values[i, j] + t * values[i, j + 1]
    return (1 - s) * low + s * ((1 - t) * values[i + 1, j] + t * values[i + 1, j + 1])


def positions(chart):
    """Abscissa and ordinate of every point of the grid."""
    first, second = np.meshgrid(chart.values["first"], chart.values["second"], indexing="ij")
    return first, np.degrees(chart.values["theta_0"]) if chart.theta_is_ordinate else second


# The picture


def stability_map(result):
    """Both directions of motion side by side."""
    chart = read_map(result)
    figure, panels = plt.subplots(1, 2, sharex=True, sharey=True, figsize=(TWO_COLUMNS, 82 * MILLIMETRE))
    norm = growth_norm(chart)
    present = set()
    for axes, way, direction, letter in zip(panels, ("forward", "backward"), (1, -1), "ab"):
        colours = draw_growth(axes, chart, way, norm)
        present |= draw_areas(axes, chart, way)
        judged = chart.values["evaluated"] == 1
        places = [place[judged] for place in positions(chart)]
        axes.plot(*places, ".", **JUDGED)
        for kind, lines in boundary_lines(result, chart, direction).items():
            for line in lines:
                axes.plot(*line, color="black", linestyle=LINES[KINDS[kind]], linewidth=1.1, solid_capstyle="round")
        axes.set_title(f"({letter}) {way}", loc="left", fontsize=8)
        axes.set_xlabel(parameter_label(chart.names[0], chart.units[0]))
        axes.grid(False)
    second = parameter_label(chart.names[1], chart.units[1])
    panels[0].set_ylabel(r"inclination $\theta_0$ [deg]" if chart.theta_is_ordinate else second)
    bar = figure.colorbar(colours, ax=panels, aspect=30, pad=0.01, ticks=growth_ticks(norm))
    bar.ax.minorticks_off()
    bar.ax.set_yticklabels([rate_text(rate) for rate in growth_ticks(norm)])
    bar.set_label(r"growth rate max Re $\lambda$ [1/s]")
    draw_legend(figure, present)
    return figure


def growth_norm(chart):
    """Symmetric, linear below the power of ten under a fifth of what half of the cells exceed."""
    rates = np.concatenate([chart.values[f"growth_rate_{way}"].ravel() for way in ("forward", "backward")])
    size = np.abs(rates[np.isfinite(rates)])
    if len(size) == 0 or size.max() == 0:
        return SymLogNorm(1, vmin=-1, vmax=1)
    linear = 10 ** np.floor(np.log10(max(np.median(size) / 5, 1e-6 * size.max())))
    return SymLogNorm(linear, vmin=-size.max(), vmax=size.max(), base=10)


def growth_ticks(norm):
    """Powers of ten from the linear part on, both signs, and zero."""
    powers = norm.linthresh * 10 ** np.arange(np.floor(np.log10(norm.vmax / norm.linthresh)) + 1)
    powers = powers[(powers > norm.linthresh) | (len(powers) < 3)]
    return [*-powers[::-1], 0, *powers]


def rate_text(rate):
    return "0" if rate == 0 else f"{rate:g}".replace("-", "\N{MINUS SIGN}")


def draw_growth(axes, chart, way, norm):
    kind = chart.values[f"kind_{way}"]
    rate = chart.values[f"growth_rate_{way}"]
    shown = np.ma.masked_where(~np.isfinite(rate) | ~(kind < JAMMED), rate)
    places = positions_without_holes(chart)
    return axes.pcolormesh(*places, shown, norm=norm, cmap="RdBu_r", shading="gouraud", rasterized=True)


def positions_without_holes(chart):
    """Scenes that are refused have no theta_0, and the drawing takes no holes."""
    horizontal, vertical = positions(chart)
    if np.isfinite(vertical).all():
        return horizontal, vertical
    return horizontal, np.where(np.isfinite(vertical), vertical, np.nanmin(vertical))


def draw_areas(axes, chart, way):
    """Hatches what has no growth rate to show; the kinds that are there."""
    kind = chart.values[f"kind_{way}"]
    for code, (colour, hatch) in AREAS.items():
        if (kind == code).any():
            inside = (kind == code).astype(float)
            axes.contourf(*positions_without_holes(chart), inside, levels=(0.5, 1.5), colors=[colour], hatches=[hatch])
    return set(np.unique(kind[np.isfinite(kind)]).astype(int))


def draw_legend(figure, present):
    handles = []
    for kind in sorted(present - {0}):
        if kind in AREAS:
            colour, hatch = AREAS[kind]
            handles.append(Patch(facecolor=colour, edgecolor="black", linewidth=0.5, hatch=hatch, label=KINDS[kind]))
        else:
            line = {"color": "black", "linestyle": LINES[KINDS[kind]], "linewidth": 1.1}
            handles.append(plt.Line2D([], [], label=f"onset of {KINDS[kind]}", **line))
    handles.append(plt.Line2D([], [], linestyle="", marker=".", label="judged", **{**JUDGED, "markersize": 3}))
    figure.suptitle(" ", fontsize=7)  # keeps room
    figure.legend(handles=handles, loc="upper center", ncol=len(handles))
