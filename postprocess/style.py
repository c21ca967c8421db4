# SPDX-License-Identifier: GPL-3.0-only
"""Styles that all pictures share: sizes, colours and lines, symbols, axis labels."""

import re
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of what draws)
import numpy as np  # noqa: E402
from matplotlib.colors import ListedColormap, LogNorm, Normalize  # noqa: E402

MILLIMETRE = 1 / 25.4
ONE_COLUMN = 85 * MILLIMETRE
TWO_COLUMNS = 170 * MILLIMETRE

# Colours told apart by the colour-blind (Okabe & Ito), and with each a line style for prints without colour.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
LINES = ("-", (0, (6, 1.5)), (0, (6, 1.5, 1.2, 1.5)), (0, (3, 1.2)), (0, (3, 1, 1, 1, 1, 1)), (0, (8, 1, 2, 1)), (0, (1.5, 1)))
MARKERS = ("o", "s", "^", "D", "v", "P", "X")

# Ends of an axis with this ratio want a logarithm.
WIDE = 15
SOLVER_ERROR = 1e-7

SYMBOLS = {
    "time": "$t$",
    "x": "$x$",
    "P": "$P$",
    "Q": "$Q$",
    "mu": r"$\mu$",
    "v_rel": r"$v_\mathrm{rel}$",
    "theta0": r"$\theta_0$",
    "slope_forward": "$C_Q$",
    "slope_backward": "$C_Q$",
    "dimensionless_forward": r"$\bar C_Q = C_Q R\,l/k$",
    "dimensionless_backward": r"$\bar C_Q = C_Q R\,l/k$",
}

# Parameters with a symbol of their own.
PARAMETERS = {
    "Friction/Factor": "friction factor",
    "Friction/Coefficient": r"friction coefficient $\mu$",
    "Lever/Depth": "lever depth",
    "Stability/Position": "position $x$",
    "Geometry/Cylinder radius": "radius $R$",
    "Geometry/Interface offset": "offset $e$",
    "Geometry/Pivot distance": "pivot distance $l$",
    "Geometry/Pivot height": "pivot height $h$",
    "Rotational spring/Stiffness": "spring stiffness $k$",
    "Contact/Stiffness": "contact stiffness $k_c$",
    "Drive/Speed": "speed $v$",
}
# Sections whose names of parameters say enough.
OWN_NAMES = ("Analysis", "Drive", "Mesh", "Time", "Condensed", "Stability", "Geometry", "Isolation")


def use_print_style():
    plt.rcParams.update(
        {
            "font.size": 8,
            "axes.labelsize": 8,
            "axes.linewidth": 0.6,
            "axes.formatter.limits": (-3, 5),
            "axes.grid": True,
            "axes.axisbelow": True,
            "grid.color": "0.88",
            "grid.linewidth": 0.5,
            "lines.linewidth": 1.2,
            "legend.fontsize": 7,
            "legend.frameon": False,
            "legend.handlelength": 2.8,
            "xtick.direction": "in",
            "xtick.major.pad": 5,  # corners where both axes have a number
            "ytick.direction": "in",
            "pdf.fonttype": 42,
            "figure.constrained_layout.use": True,
        }
    )


def look(index):
    """Colour and line of the index-th curve."""
    return {"color": COLOURS[index % len(COLOURS)], "linestyle": LINES[index % len(LINES)]}


def label(units, column):
    """Axis label with the unit as the file gives it."""
    symbol = SYMBOLS.get(column, column.replace("_", " "))
    unit = units.get(column, "1")
    if unit in ("", "1"):
        return symbol
    return f"{symbol} [{in_maths(unit)}]"


def with_unit(text, unit):
    """A number and its unit, as in a legend."""
    return text if unit in ("", "1") else f"{text} {in_maths(unit)}"


def in_maths(unit):
    """Powers raised."""
    return re.sub(r"\^(-?\w+)", r"$^{\1}$", unit)


def parameter_label(name, unit="1"):
    """Returns the label of the parameter Section/Name for an axis."""
    section, _, own = name.partition("/")
    text = PARAMETERS.get(name, own.lower() if section in OWN_NAMES else f"{section} {own}".lower())
    text = text.replace("young", "Young").replace("poisson", "Poisson")
    return text if unit in ("", "1") else f"{text} [{in_maths(unit)}]"


def folded(text):
    """Returns a label in lines that are not cut beside a panel of a third of the page."""
    width = 28 + len(re.findall(r"[$^{}]", text))
    return "\n".join(textwrap.wrap(text, width, break_long_words=False))


def set_labels(axes, units, over, column):
    axes.set_xlabel(label(units, over))
    axes.set_ylabel(label(units, column))


def panel_letter(axes, letter):
    axes.set_title(f"({letter})", loc="left", fontsize=8)


def show_legend(axes, **arguments):
    """A legend where there is more than one thing to tell apart."""
    if len(axes.get_legend_handles_labels()[0]) > 1:
        axes.legend(**arguments)


def legend_on_top(figure, handles, names):
    """One legend of all panels, above them, with as many columns as the width takes."""
    if not names:
        return
    letters = 120 * figure.get_figwidth() / TWO_COLUMNS
    columns = max(1, min(len(names), 5, int(letters // (max(map(len, names)) + 8))))
    rows = -(-len(names) // columns)
    figure.suptitle("\n" * round(1.25 * (rows - 1)) or " ", fontsize=8.5)  # keeps room
    figure.legend(handles, names, loc="upper center", ncol=columns)


def make_scale(numbers):
    """Colours of numbers, from dark to light; logarithmic where they are far apart."""
    low, high = min(numbers), max(numbers)
    norm = LogNorm(low, high) if low > 0 and high / low > WIDE else Normalize(low, high)
    return plt.cm.ScalarMappable(norm, ListedColormap(plt.cm.viridis(np.linspace(0, 0.9, 256))))


def is_signal(difference, whole):
    """Tells if a difference exceeds the solver's error, relative to `whole`."""
    return np.nanmax(np.abs(difference), initial=0) > SOLVER_ERROR * np.nanmax(np.abs(whole), initial=0)


def envelope(time, values, begin, end, parts):
    """Time and value of the largest value in each of the equal parts of a span of time; for what swings too fast to be drawn."""
    shown = np.flatnonzero((time >= begin) & (time <= end) & np.isfinite(values))
    part = np.minimum((time[shown] - begin) * parts / ((end - begin) or 1), parts - 1).astype(int)
    ordered = shown[np.lexsort((values[shown], part))]
    peaks = ordered[np.flatnonzero(np.diff(np.sort(part), append=parts))]
    return time[peaks], values[peaks]
