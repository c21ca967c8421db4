# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of a vibration analysis: eigenvalues, mode shapes, what feeds the growth and what each ingredient does."""

import re
import textwrap

import numpy as np
from matplotlib.ticker import FuncFormatter, NullLocator

from shades import rounded
from sprag.results import NotAResult
from style import COLOURS, MILLIMETRE, ONE_COLUMN, TWO_COLUMNS, panel_letter, parameter_label, plt

KINDS = ("stable", "flutter", "divergence")
FEEDS = (
    ("friction_rotation", "friction on rotation"),
    ("friction_bending", "friction on bending"),
    ("friction_support", "friction on support"),
    ("friction_speed", "friction, velocities"),
    ("contact_damping", "contact damping"),
    ("structure_damping", "structure damping"),
)


def vibration_pictures(result):
    """{picture name: figure}. Throws NotAResult."""
    modes = result.groups["modes"]
    pictures = {}
    if len(modes["frequency"]) > 0:
        pictures["modes"] = mode_shapes(modes)
    if "verdict" in result.summary:
        pictures["stability"] = stability(result)
    if searches := {name: group for name, group in result.groups.items() if name.startswith("critical_")}:
        pictures["critical"] = critical(result, searches)
    if not pictures:
        raise NotAResult(f"{result.folder}: no mode was found")
    return pictures


def critical(result, searches):
    """Growth rate of the worst slide over each parameter, shaded where it vibrates, and where the verdict changes. Over a stroke also a map."""
    # Over the position itself it would be a line.
    has_map = [name != "critical_stability_position" and len(np.unique(tried.get("place_x", ()))) > 1 for name, tried in searches.items()]
    heights = [height for mapped in has_map for height in ((48, 48) if mapped else (48,))]
    figure, panels = plt.subplots(len(heights), 1, figsize=(TWO_COLUMNS, (12 + sum(heights)) * MILLIMETRE), squeeze=False)
    rest = iter(panels.flat)
    for mapped, (name, tried) in zip(has_map, searches.items()):
        axes = next(rest)
        order = np.argsort(tried["value"])
        values, rates = (np.asarray(tried[column])[order] for column in ("value", "growth_rate"))
        axes.plot(values, rates, "o-", color=COLOURS[0], markersize=2.5)
        axes.axhline(0, color="black", linewidth=0.8)
        axes.margins(x=0)
        axes.set_ylim(*axes.get_ylim())
        axes.axhspan(0, max(axes.get_ylim()[1], 0), color=COLOURS[1], alpha=0.12, linewidth=0)
        changes = [change for entry, change in result.summary.items() if re.fullmatch(rf"{name}_\d+", entry)]
        for change in changes:
            axes.axvline(change, color="black", linewidth=0.8, linestyle="--")
        for ending, style, label in (("likely", "-.", "for 95 % of the constants"), ("own", ":", "with the scene's constants")):
            limits = [limit for entry, limit in result.summary.items() if re.fullmatch(rf"{name}_\d+_{ending}", entry)]
            for limit in limits:
                axes.axvline(limit, color="black", linewidth=0.8, linestyle=style, label=label if limit == limits[0] else None)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7)
        parameter, _, verdicts = result.summary[f"{name}_verdicts"].partition(" from ")
        axes.set_title("\n".join(textwrap.wrap(verdicts.partition(": ")[2], 90)), fontsize=8, loc="left")
        axes.set_xlabel(parameter_label(parameter, tried["value"].unit))
        axes.set_ylabel("growth rate [1/s]")
        if mapped:
            below = next(rest)
            draw_places(below, tried)
            for number, change in enumerate(changes, 1):
                error = result.summary.get(f"{name}_{number}_error", 0.0)
                if error > 0:
                    below.axvspan(change - error, change + error, color="black", alpha=0.25, linewidth=0, label="error" if number == 1 else None)
                below.axvline(change, color="black", linewidth=0.8, linestyle="--")
            below.legend(fontsize=7, loc="upper right", frameon=True, framealpha=1)
            below.set_xlabel(axes.get_xlabel())
            axes.sharex(below)
    return figure


def draw_places(axes, tried):
    """Shades the places of the stroke where a slide vibrates, each way, over the values tried; grey where it jams."""
    values, x = np.unique(tried["place_value"]), np.unique(tried["place_x"])
    for way, name, colour in ((1, "forward", COLOURS[1]), (-1, "backward", COLOURS[0])):
        rates = np.full((len(x), len(values)), np.nan)
        for column, value in enumerate(values):
            here = (np.asarray(tried["place_value"]) == value) & (np.asarray(tried["place_direction"]) == way)
            if here.any():
                rates[:, column] = np.interp(x, np.asarray(tried["place_x"])[here], np.asarray(tried["place_growth_rate"])[here])
        if np.isnan(rates).all():
            continue
        axes.contourf(values, x, np.isnan(rates), levels=(0.5, 1.5), colors="0.8")
        axes.contourf(values, x, rates, levels=(0, max(1, np.nanmax(rates))), colors=[colour], alpha=0.25)
        axes.fill_between((), (), facecolor=colour, alpha=0.25, label=f"unstable {name}")
    axes.plot(tried["place_value"], tried["place_x"], ",", color="0.5")
    axes.set_ylabel("position $x$ [mm]")


def mode_shapes(modes, most=6):
    """Deflection of the lever's face over a cycle: eight phases, the first one drawn strongly.

    In three dimensions it is that of an edge of the face, of sideways modes along the cylinder's axis. Of a mirrored pair both, the second one mirrored, below the first.
    """
    chosen = shown_modes(modes, most)
    columns = min(len(chosen), 2)
    rows = (len(chosen) + 1) // 2
    size = (TWO_COLUMNS if columns == 2 else ONE_COLUMN, (16 + 28 * rows) * MILLIMETRE)
    figure, panels = plt.subplots(rows, columns, sharex=True, sharey=True, figsize=size, squeeze=False)
    for axes, mode in zip(panels.flat, chosen):
        draw_shape(axes, modes, mode)
    for axes in panels.flat[len(chosen) :]:
        axes.set_axis_off()
    for column in range(columns):
        lowest = panels[(len(chosen) - 1 - column) // columns][column]
        lowest.set_xlabel(r"lever coordinate $\xi$ [mm]")
        lowest.tick_params(labelbottom=True)
    figure.supylabel("deflection over the largest,\nrotation included", fontsize=8, multialignment="center")
    return figure


def shown_modes(modes, most):
    """The lowest ones, those that grow among them."""
    growing = list(np.flatnonzero(modes["kind"] > 0))
    lowest = [i for i in range(len(modes["frequency"])) if i not in growing]
    return sorted((growing + lowest)[:most])


def draw_shape(axes, modes, mode):
    xi, shapes = deflections(modes, mode)
    colour = COLOURS[1] if modes["kind"][mode] > 0 else COLOURS[0]
    height = 0 if len(shapes) == 1 else 1.3
    for side, shape in zip((1, -1), shapes):
        axes.axhline(side * height, color="black", linewidth=0.5)
        for phase in np.arange(8) * np.pi / 4:
            strong = phase == 0
            place = side * (height + (shape * np.exp(1j * phase)).real)
            axes.plot(xi, place, color=colour, linewidth=1.4 if strong else 0.5)
    axes.set_ylim(-1.1 - height, 1.1 + height)
    if height:
        axes.set_yticks((-height, height), ("second", "first"))
    axes.set_xlim(0, xi[-1])
    axes.set_title(mode_name(modes, mode), fontsize=8, loc="left")


def deflections(modes, mode):
    """Lever coordinates in their order, and each lever's complex deflection there over the largest one."""
    xi = modes["xi"]
    order = np.argsort(xi)
    if len(xi) == 1:  # a rigid lever has no shape but its rotation
        xi, order = np.array((0.0, 200.0)), [0, 1]
    levers = ("_", "_2_") if "rotation_2_real" in modes else ("_",)
    shapes = []
    for lever in levers:
        complex_part = lambda name: modes[f"{name}{lever}real"][mode] + 1j * modes[f"{name}{lever}imaginary"][mode]
        if motion_across(modes, mode) == "sideways":
            shapes.append(complex_part("sideways")[order])
            continue
        bent = complex_part("across") if len(modes["xi"]) > 1 else 0
        shapes.append((bent + xi * complex_part("rotation"))[order])
    largest = max((shape[np.abs(shape).argmax()] for shape in shapes), key=abs)
    return xi[order], [shape / (largest or 1) for shape in shapes]


def motion_across(modes, mode):
    """Returns the name of a mode's largest motion in three dimensions; empty in a plane."""
    if "twisting" not in modes:
        return ""
    shares = {name: modes[name][mode] for name in ("plane", "twisting", "sideways")}
    return max(shares, key=shares.get)


def mode_name(modes, mode):
    kind = KINDS[int(modes["kind"][mode])]
    growth = modes["growth_rate"][mode]
    rate = f", {rate_text(growth)} 1/s" if abs(growth) > 1e-9 * (1 + modes["frequency"][mode]) else ""
    motion = f", {motion_name(modes['mirroring'][mode])}" if "mirroring" in modes else ""
    if motion_across(modes, mode) in ("twisting", "sideways"):
        motion = f", {motion_across(modes, mode)}"
    return frequency_text(modes["frequency"][mode]) + rate + (f", {kind}" if kind != "stable" else "") + motion


def motion_name(mirroring):
    """Returns the name of a pair's motion."""
    return "mirroring" if mirroring > 0.9 else "swinging" if mirroring < -0.9 else "uneven"


def frequency_text(frequency):
    return f"{frequency:.0f} Hz" if frequency >= 1000 else f"{frequency:.4g} Hz"


def rate_text(rate):
    text = f"{rate:+.0f}" if abs(rate) >= 1000 else f"{rate:+.3g}"
    return text.replace("-", "\N{MINUS SIGN}")


def stability(result):
    """(a) Eigenvalues, (b) the slide with one ingredient left out, (c) what feeds each mode; without modes (b) alone."""
    modes = result.groups["modes"]
    if len(modes["frequency"]) == 0:
        figure, axes = plt.subplots(figsize=(ONE_COLUMN, 55 * MILLIMETRE))
        draw_roles(axes, result.summary)
        return figure
    figure = plt.figure(figsize=(TWO_COLUMNS, 125 * MILLIMETRE))
    grid = figure.add_gridspec(2, 2)
    places = (grid[0, 0], grid[0, 1], grid[1, :])
    panels = [figure.add_subplot(place) for place in places]
    draw_eigenvalues(panels[0], modes)
    draw_roles(panels[1], result.summary)
    draw_feeds(panels[2], modes)
    for axes, letter in zip(panels, "abc"):
        panel_letter(axes, letter)
    return figure


def draw_eigenvalues(axes, modes):
    for kind, (name, marker) in enumerate(zip(KINDS, "osD")):
        selected = modes["kind"] == kind
        if selected.any():
            axes.plot(modes["growth_rate"][selected], modes["frequency"][selected], marker, color=COLOURS[kind], markersize=4, label=name)
    scale_eigenvalues(axes, modes["growth_rate"], modes["frequency"])
    axes.legend(loc="upper right", handlelength=1, frameon=True, framealpha=1, edgecolor="none")  # fast modes are damped


FAR_DAMPED = 30.0  # over the linear part of the axis


def scale_eigenvalues(axes, rates, frequencies):
    """The stability limit and the slow modes large: both axes logarithmic away from zero. Modes damped far more are counted at the edge."""
    axes.axvline(0, color="black", linewidth=0.8)
    use_log_scale(axes, frequencies)
    lowest = np.abs(rates[np.argsort(frequencies)[:3]]).max(initial=1)
    linear = 2 * rounded(max(lowest, rates.max(initial=0)))
    axes.margins(x=0.06)
    beyond = rates < -FAR_DAMPED * linear
    if beyond.any() and not beyond.all():
        note = f"{beyond.sum()} more, to {rate_text(rates.min())} 1/s"
        axes.annotate(f"\N{LEFTWARDS ARROW} {note}", (0.03, 0.04), xycoords="axes fraction", fontsize=7)
        rates = rates[~beyond]
        axes.set_xlim(-1.3 * max(np.abs(rates).max(), 3 * linear), max(1.2 * rates.max(), 0.4 * linear))
    if (farthest := np.abs(rates).max(initial=0)) > linear:
        axes.set_xscale("symlog", linthresh=linear, linscale=2)
        decades = 10.0 ** np.arange(np.floor(np.log10(linear)) + 1, np.log10(farthest) + 0.3)
        decades = decades[decades >= 3 * linear]
        is_crowded = len(decades) > 0 and decades[0] < 10 * linear
        ticks = [*-decades[::-1], *([] if is_crowded else [-linear]), -linear / 2, 0, linear / 2, linear]
        low, high = axes.get_xlim()
        axes.set_xticks([tick for tick in ticks if low <= tick <= high])
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}".replace("-", "\N{MINUS SIGN}")))
        axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel(r"growth rate $\mathrm{Re}\,\lambda$ [1/s]")
    axes.set_ylabel(r"frequency $\mathrm{Im}\,\lambda/2\pi$ [Hz]")


def use_log_scale(axes, frequencies):
    """Logarithmic; with zero on it where a mode does not oscillate."""
    oscillating = frequencies[frequencies > 0]
    if len(oscillating) == len(frequencies):
        axes.set_yscale("log")
        axes.set_ylim(frequencies.min() / 3, frequencies.max() * 2)  # room for the legend
    elif len(oscillating) > 0:
        axes.set_yscale("symlog", linthresh=10 ** np.floor(np.log10(oscillating.min())), linscale=0.5)


def draw_roles(axes, summary):
    ending = "_growth_rate"
    names = [name[: -len(ending)] for name in summary if name.startswith("without_") and name.endswith(ending)]
    # A slide that is jammed has no growth rate.
    rates = [summary.get("growth_rate", np.nan)] + [summary[name + ending] for name in names]
    verdicts = [summary["verdict"]] + [summary[f"{name}_verdict"] for name in names]
    texts = ["as it is"] + [name.replace("_", " ").replace("friction derivative", "$\\mu'(v)$") for name in names]
    for place, (rate, verdict) in enumerate(zip(rates, verdicts)):
        colour = COLOURS[KINDS.index(verdict)] if verdict in KINDS else "black"
        if np.isfinite(rate):
            axes.barh(place, rate, 0.6, color=colour)
        else:
            axes.annotate(verdict, (0, place), xytext=(4, 0), textcoords="offset points", va="center", color=colour, fontsize=7)
    axes.axvline(0, color="black", linewidth=0.8)
    if not np.isfinite(rates).any():
        axes.set_xlim(0, 1)
        axes.set_xticks([])
    axes.set_yticks(range(len(texts)), texts)
    axes.set_ylim(len(texts) - 0.4, -0.6)
    axes.set_xlabel("largest growth rate [1/s]")
    axes.grid(axis="y", visible=False)


def draw_feeds(axes, modes, most=4):
    """Bars side by side for each mode, those that count somewhere."""
    chosen = shown_modes(modes, most)
    parts = [modes[f"growth_by_{name}"][chosen] for name, _ in FEEDS]
    least = 1e-3 * np.abs(parts).max()
    used = [index for index, values in enumerate(parts) if np.abs(values).max() > least]
    width = 0.8 / max(len(used), 1)
    for place, index in enumerate(used):
        places = np.arange(len(chosen)) + (place - (len(used) - 1) / 2) * width
        axes.bar(places, parts[index], width, color=COLOURS[index], label=FEEDS[index][1])
    axes.axhline(0, color="black", linewidth=0.8)
    names = [f"{frequency_text(modes['frequency'][i])}\n{rate_text(modes['growth_rate'][i])} 1/s" for i in chosen]
    axes.set_xticks(range(len(chosen)), names)
    axes.set_xlabel("mode: frequency and growth rate")
    axes.set_ylabel("part of the growth rate [1/s]")
    axes.grid(axis="x", visible=False)
    if used:
        style = {"handlelength": 1, "columnspacing": 1.2, "borderaxespad": 0.3}
        axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=min(len(used), 3), **style)
