# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of a sprag-slip run: growth beside its eigenvalue, the vibration it leads to, and what lives along the stroke."""

import numpy as np

from style import COLOURS, LINES, MILLIMETRE, TWO_COLUMNS, legend_on_top, panel_letter, plt

AWAY, BACK = 0, 1
WAYS = {"away": (AWAY, "o", "away from"), "back": (BACK, "s", "back to")}
PREDICTED = {"color": "black", "linestyle": (0, (4, 3)), "linewidth": 0.9}
SLIDE, CYCLE, IRREGULAR, UNDECIDED = range(4)
MINUS = "\N{MINUS SIGN}"
SHADE = {"color": "0.88", "linewidth": 0, "zorder": 0}


def sprag_slip_pictures(result):
    pictures = {"growth": growth(result)}
    if np.isfinite(number(result, "cycle_begin")):
        pictures["cycle"] = cycle(result)
    if "continuation" in result.groups:
        pictures["continuation"] = continuation(result)
    return pictures


def number(result, name):
    return float(result.summary.get(name, np.nan))


# Growth


def growth(result):
    """The envelope beside what the eigenvalue says, once it is measured, and P from the perturbation on."""
    measured = result.groups.get("growth")
    if measured is None or len(measured["time"]) == 0:
        figure, force = plt.subplots(figsize=(TWO_COLUMNS / 2, 66 * MILLIMETRE))
        draw_force(force, result, 0.0)
        return figure
    figure, (sizes, force) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 66 * MILLIMETRE))
    draw_envelope(sizes, result, measured)
    draw_force(force, result, measured["time"][-1])
    for axes, letter in zip((sizes, force), "ab"):
        panel_letter(axes, letter)
    return figure


def draw_envelope(axes, result, measured):
    time = 1e3 * measured["time"]
    step = max(1, len(time) // 40)
    axes.semilogy(time[::step], measured["amplitude"][::step], "o", color=COLOURS[0], markersize=3.5, label=in_time(result))
    axes.semilogy(time, measured["predicted"], label=by_eigenvalue(result), **PREDICTED)
    axes.set_xlabel("$t$ [ms]")
    axes.set_ylabel("amplitude of overlap over its mean")
    axes.legend(loc="upper left" if number(result, "linear_growth_rate") > 0 else "upper right")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * (high / low) ** 0.25)  # room for the legend


def in_time(result):
    return rates("in time", result, "measured")


def by_eigenvalue(result):
    return rates("eigenvalue", result, "linear")


def rates(name, result, kind):
    growth, frequency = (number(result, f"{kind}_{what}") for what in ("growth_rate", "frequency"))
    return f"{name}: {growth:#.5g} 1/s, {frequency:#.5g} Hz".replace("-", MINUS)


def draw_force(axes, result, grown):
    """P while it grows until the time `grown`, and on to where it has grown; all of it while the run goes on."""
    time, P = (result.table[name] for name in ("time", "P"))
    lost = time[P == 0]
    end = max(grown, lost[0] if len(lost) else 0) + 20 / frequency(result)
    shown = time <= np.nanmin((end, number(result, "cycle_begin"), time[-1]))
    axes.plot(1e3 * time[shown], P[shown], color=COLOURS[0], linewidth=0.5)
    axes.axhline(result.table["P_quasi_static"][0], label="the slide", **PREDICTED)
    axes.set_xlabel("$t$ [ms]")
    axes.set_ylabel("$P$ [N]")
    axes.legend(loc="upper left" if number(result, "linear_growth_rate") > 0 else "upper right")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.12 * (high - low))  # room for the legend


def frequency(result):
    found = number(result, "linear_frequency")
    return found if found > 0 else abs(number(result, "linear_growth_rate")) / (2 * np.pi)


# The vibration it leads to


def cycle(result, shown_periods=8):
    """P and indentation over a few periods, shaded out of contact; indentation and rotation against one another."""
    figure = plt.figure(figsize=(TWO_COLUMNS, 84 * MILLIMETRE))
    grid = figure.add_gridspec(2, 5)
    force = figure.add_subplot(grid[0, :3])
    depth = figure.add_subplot(grid[1, :3], sharex=force)
    portrait = figure.add_subplot(grid[:, 3:])
    table = result.table
    rows = np.flatnonzero(table["time"] >= number(result, "cycle_begin"))
    time = 1e3 * (table["time"][rows] - table["time"][rows][0])
    few = time <= 1e3 * shown_periods / frequency(result)
    draw_periods(force, time, table["P"][rows], few, table["P"][rows] == 0)
    draw_periods(depth, time, 1e3 * table["indentation"][rows], few, table["P"][rows] == 0)
    force.axhline(number(result, "P"), **PREDICTED)
    force.set_ylabel("$P$ [N]")
    force.tick_params(labelbottom=False)
    depth.axhline(1e3 * number(result, "indentation"), **PREDICTED)
    depth.set_ylabel(r"indentation [$\mu$m]")
    depth.set_xlabel("$t$ [ms]")
    draw_portrait(portrait, table, rows)
    for axes, letter in zip((force, depth, portrait), "abc"):
        panel_letter(axes, letter)
    figure.suptitle(cycle_text(result), fontsize=8)
    return figure


def draw_periods(axes, time, values, few, is_open):
    axes.plot(time[few], values[few], color=COLOURS[0], linewidth=0.9)
    axes.fill_between(time[few], 0, 1, where=is_open[few], transform=axes.get_xaxis_transform(), step="mid", **SHADE)
    axes.set_xlim(0, time[few][-1])


def draw_portrait(axes, table, rows):
    """Rotation and its rate: the mode's largest motion, in and out of contact."""
    angle = 1e3 * (table["theta"][rows] - table["theta"][rows].mean())
    rate = table["theta_rate"][rows]
    axes.plot(angle, rate, color=COLOURS[0], linewidth=0.5)
    is_open = table["P"][rows] == 0
    axes.plot(angle[is_open], rate[is_open], ".", color=COLOURS[1], markersize=1.2, label="contact open")
    axes.set_xlabel(r"$\theta$ less its mean [mrad]")
    axes.set_ylabel(r"$\dot\theta$ [rad/s]")
    if is_open.any():
        axes.legend(loc="upper right", markerscale=5, handlelength=1)
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.1 * (high - low))  # room for the legend


def cycle_text(result):
    kind = {"cycle": "Limit cycle", "irregular": "Irregular vibration"}.get(result.summary.get("cycle"), "Vibration")
    return (
        f"{kind} at $x$ = {number(result, 'x'):.4g} mm: amplitude of $P$ {number(result, 'cycle_amplitude_P'):.4g} N, "
        f"{number(result, 'cycle_frequency'):.4g} Hz, contact open {100 * number(result, 'cycle_open_share'):.3g} % of the time"
    )


# Along the stroke


def continuation(result):
    """Amplitude over x going away and coming back, shaded where slide and vibration coexist; below, the linear growth rate."""
    figure, (sizes, rate) = plt.subplots(
        2, 1, sharex=True, figsize=(TWO_COLUMNS, 100 * MILLIMETRE), gridspec_kw={"height_ratios": (3, 2)}
    )
    points = result.groups["continuation"]
    for way, (index, marker, name) in WAYS.items():
        draw_branch(sizes, points, way, f"{name} $x$ = {number(result, 'x'):.4g} mm", marker, index)
    sizes.set_ylabel("amplitude\nof $P$ [N]")
    draw_rate(rate, points)
    shade_coexistence(result, (sizes, rate))
    if any((points[f"kind_{way}"] == IRREGULAR).any() for way in WAYS):
        sizes.plot([], [], "o", color="black", markerfacecolor="white", markersize=4, label="hollow: irregular")
    if any((points[f"kind_{way}"] == UNDECIDED).any() for way in WAYS):
        sizes.plot([], [], "x", color="black", markersize=6, label="undecided")
    legend_on_top(figure, *sizes.get_legend_handles_labels())
    rate.set_xlabel("$x$ [mm]")
    for axes, letter in zip((sizes, rate), "ab"):
        panel_letter(axes, letter)
    figure.align_ylabels()
    return figure


def draw_branch(axes, points, way, name, marker, index):
    """Draws vibrations and slides, each joined along the way, with dots between the two kinds. Irregular vibrations are hollow,
    undecided ones crossed out."""
    order = np.argsort(points["x"])
    x, kind = points["x"][order], points[f"kind_{way}"][order]
    vibrates = np.isin(kind, (CYCLE, IRREGULAR))
    size = np.where(kind == SLIDE, 0.0, points[f"amplitude_P_{way}"][order])
    size[~np.isfinite(kind)] = np.nan
    look = {"color": COLOURS[index], "markersize": 5 - 2 * index}
    for begin in np.flatnonzero(np.isfinite(size[:-1]) & np.isfinite(size[1:])):
        joined = vibrates[begin] == vibrates[begin + 1]
        line = {"linestyle": LINES[index], "linewidth": 0.9} if joined else {"linestyle": ":", "linewidth": 0.7}
        axes.plot(x[begin : begin + 2], size[begin : begin + 2], color=COLOURS[index], **line)
    axes.plot(x, size, linestyle="", marker=marker, **look)
    axes.plot([], [], marker=marker, linestyle=LINES[index], linewidth=0.9, label=name, **look)
    irregular, undecided = kind == IRREGULAR, kind == UNDECIDED
    axes.plot(x[irregular], size[irregular], marker, markerfacecolor="white", **look)
    axes.plot(x[undecided], size[undecided], "x", color="black", markersize=6)


def draw_rate(axes, points):
    order = np.argsort(points["x"])
    x, growing = points["x"][order], points["growth_rate"][order]
    axes.plot(x, growing, color="black", marker=".", markersize=4, linewidth=0.9)
    axes.axhline(0, color="black", linewidth=0.5)
    axes.fill_between(x, 0, growing, where=growing > 0, interpolate=True, color=COLOURS[1], alpha=0.3, linewidth=0)
    axes.set_ylabel("linear growth\nrate [1/s]")


def shade_coexistence(result, panels):
    begin, end = (number(result, f"coexistence_{name}") for name in ("from", "to"))
    if not np.isfinite(begin + end):
        return
    for axes in panels:
        axes.axvspan(begin, end, **SHADE)
    panels[0].axvspan(begin, begin, label=f"coexistence, {begin:.4g} to {end:.4g} mm", **SHADE)
