# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of sweeps of the slope (Figs. 10 and 11 of the paper) and of contact laws fitted to an indentation."""

import numpy as np

from style import COLOURS, MILLIMETRE, ONE_COLUMN, TWO_COLUMNS, look, make_scale, plt, set_labels, show_legend


def slope_sweep(result):
    """The dimensionless slope over mu (Fig. 10 of the paper) or theta0 (Fig. 11)."""
    return slopes_over_coefficient([result]) if "mu" in result.table else slopes_over_inclination(result)


def slope_panels(units, over):
    figure, panels = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 70 * MILLIMETRE))
    for axes, direction, letter in zip(panels, ("forward", "backward"), "ab"):
        set_labels(axes, units, over, f"dimensionless_{direction}")
        axes.set_title(f"({letter}) {direction}", loc="left", fontsize=8)
        axes.axhline(0, color="black", linewidth=0.5)
    return figure, panels


def slopes_over_coefficient(results, names=None):
    figure, panels = slope_panels(results[0].units, "mu")
    for axes, direction in zip(panels, ("forward", "backward")):
        for index, result in enumerate(results):
            name = names[index] if names else result.name
            axes.plot(result.table["mu"], result.table[f"dimensionless_{direction}"], label=name, **look(index))
        axes.set_xlim(left=0)
        show_legend(axes)
    return figure


def slopes_over_inclination(result):
    """A curve for every e/R: up to five of them named in a legend, more by a scale of colours."""
    figure, panels = slope_panels({**result.units, "theta0": "deg"}, "theta0")
    ratios = result.table["offset_ratio"]
    looks, scale = choose_looks(np.unique(ratios))
    for axes, direction in zip(panels, ("forward", "backward")):
        for ratio, line_look in looks.items():
            rows = ratios == ratio
            theta0 = np.degrees(result.table["theta0"][rows])
            axes.plot(theta0, result.table[f"dimensionless_{direction}"][rows], label=f"{ratio:g}", **line_look)
        axes.set_xlim(left=0)
        if scale is None:
            axes.legend(title="$e/R$", title_fontsize=7)
    if scale is not None:
        figure.colorbar(scale, ax=panels, aspect=30, pad=0.01, label="$e/R$")
    return figure


def choose_looks(ratios):
    if len(ratios) <= len(COLOURS):
        return {ratio: look(index) for index, ratio in enumerate(ratios)}, None
    scale = make_scale(ratios)
    return {ratio: {"color": scale.to_rgba(ratio), "linewidth": 0.9} for ratio in ratios}, scale


def contact_law(result):
    """P over the local approach: indentation by finite elements and the law fitted to it; below, how far the two are apart."""
    size = (ONE_COLUMN, 90 * MILLIMETRE)
    figure, (forces, errors) = plt.subplots(2, 1, sharex=True, figsize=size, gridspec_kw={"height_ratios": (3, 1)})
    local, P, fitted = (result.table[name] for name in ("local", "P", "P_fitted"))
    forces.plot(local, P, "o", color=COLOURS[0], markersize=3, label="finite elements")
    stiffness, exponent = (result.summary[name] for name in ("stiffness", "exponent"))
    forces.plot(local, fitted, label=rf"${stiffness:.5g}\,\delta^{{{exponent:.4g}}}$", **look(1))
    forces.set_ylabel("$P$ [N]")
    forces.set_ylim(bottom=0)
    show_legend(forces)
    errors.plot(local, 100 * (fitted / P - 1), **look(1))
    errors.axhline(0, color="black", linewidth=0.5)
    errors.set_ylabel("error [%]")
    errors.set_xlabel(r"local approach $\delta$ [mm]")
    errors.set_xlim(left=0)
    return figure
