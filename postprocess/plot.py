#!/usr/bin/python3
"""Draws result folders of sprag: forces, contact, fields, sensors, reversals, energies, sweeps, calibrations, comparisons."""

import argparse
import sys
from pathlib import Path

import numpy as np

from calibration import calibration, is_calibration
from comparison import comparison
from fields import fields
from frames import written_frames
from map import is_map, stability_map
from pair import has_pair, pair_of_levers
from results import NotAResult, read_result, script
from sensors import has_sensors, sensor_forces
from sprag_slip import is_sprag_slip, sprag_slip_pictures
from study import is_study, study_pictures
from style import COLOURS, MARKERS, MILLIMETRE, ONE_COLUMN, TWO_COLUMNS  # noqa: F401  (for figures.py and mesh.py)
from style import label, legend_on_top, look, panel_letter, plt, set_labels, show_legend, use_print_style  # noqa: F401
from transient import energy, has_reversal, is_transient, reversal
from vibration import vibration_pictures

# Forces


def draw_column(axes, result, over, column, index):
    """A column over another, and dashed what the closed form has to say on it."""
    axes.plot(result.table[over], result.table[column], label=result.name, **look(index))
    reference = f"{column}_closed_form"
    if result.has(reference):
        named = "closed form" in axes.get_legend_handles_labels()[1]
        axes.plot(
            result.table[over],
            result.table[reference],
            color="black",
            linestyle=(0, (4, 4)),
            linewidth=0.8,
            label=None if named else "closed form",
        )


def forces_over_time(results):
    """x, P and Q over time (Fig. 7 of the paper)."""
    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(ONE_COLUMN, 120 * MILLIMETRE))
    for axes, column, letter in zip(panels, ("x", "P", "Q"), "abc"):
        for index, result in enumerate(results):
            draw_column(axes, result, "time", column, index)
        axes.set_ylabel(label(results[0].units, column))
        panel_letter(axes, letter)
    panels[-1].set_xlabel(label(results[0].units, "time"))
    figure.align_ylabels()
    show_legend(panels[1])
    return figure


def forces_over_x(results):
    """P and Q over x with the direction of motion and the line C_Q x (Figs. 8 and 9 of the paper)."""
    figure, panels = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 72 * MILLIMETRE))
    for axes, column, letter in zip(panels, ("P", "Q"), "ab"):
        for index, result in enumerate(results):
            draw_column(axes, result, "x", column, index)
        set_labels(axes, results[0].units, "x", column)
        panel_letter(axes, letter)
    draw_slopes(panels[1], results)
    for axes, column in zip(panels, ("P", "Q")):
        draw_directions(axes, results[0], column)
    panels[1].axhline(0, color="black", linewidth=0.5)
    show_legend(panels[1])
    return figure


def draw_slopes(axes, results):
    """The dotted line Q = C_Q x of eq. 16; one for all results that share it."""
    known = [r for r in results if np.isfinite(r.summary.get("slope_forward", np.nan))]
    slopes = {round(r.summary["slope_forward"], 9): r for r in known}
    for slope, result in slopes.items():
        end = np.nanmax(result.table["x"])
        name = f"$C_Q x$, $C_Q$ = {slope:.4f} {result.entry_units['slope_forward']}"
        axes.plot([0, end], [0, slope * end], color="black", linestyle=":", linewidth=1.2, label=name)


def draw_directions(axes, result, column):
    """An arrow along the first stroke each way."""
    x, y = result.table["x"], result.table[column]
    for sign in (1, -1):
        stroke = first_stroke(x, sign)
        if len(stroke) > 2:
            draw_arrow(axes, x[stroke], y[stroke])


def first_stroke(x, sign):
    """Indices of the first run of steps in one direction."""
    moving = np.flatnonzero(sign * np.diff(x) > 0)
    if len(moving) == 0:
        return moving
    gaps = np.flatnonzero(np.diff(moving) > 1)
    last = moving[gaps[0]] if len(gaps) else moving[-1]
    return np.arange(moving[0] + 1, last + 2)


def draw_arrow(axes, x, y):
    """An arrow head on the curve halfway along the stroke."""
    path = np.cumsum(np.abs(np.diff(x, prepend=x[0])))
    tail, head = np.interp(path[-1] * np.array((0.46, 0.56)), path, np.arange(len(x)))
    steps = np.arange(len(x))
    ends = [(np.interp(at, steps, x), np.interp(at, steps, y)) for at in (tail, head)]
    if np.isfinite(ends).all():
        axes.annotate(
            "",
            xy=ends[1],
            xytext=ends[0],
            arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1, "mutation_scale": 10},
        )


# Contact


def contact(result):
    """Pressure along the friction face at a few x; contact width, penetration and indentation over x."""
    figure, panels = plt.subplots(2, 2, figsize=(TWO_COLUMNS, 120 * MILLIMETRE))
    draw_pressures(panels[0], result.face)
    draw_widths(panels[1][0], result)
    draw_depths(panels[1][1], result)
    for axes, letter in zip(panels.flat, "abcd"):
        panel_letter(axes, letter)
    return figure


def draw_pressures(panels, face, count=5):
    """Along the whole path of the contact, and each about its own centre."""
    chosen = chosen_steps(face, count)
    if not chosen:
        return
    for index, step in enumerate(chosen):
        patch = pressed_points(face, step)
        xi, pressure, centre = face.xi[patch], face.pressure[step][patch], centre_of_pressure(face, step)
        panels[0].plot(xi, pressure, label=f"{face.x[step]:.3g} {face.units['x']}", **look(index))
        panels[1].plot(xi - centre, pressure, marker=MARKERS[index], markersize=2.5, **look(index))
    panels[0].set_ylim(top=1.5 * panels[0].get_ylim()[1])  # room for the legend
    panels[0].set_xlabel(f"lever coordinate $\\xi$ [{face.units['xi']}]")
    panels[1].set_xlabel(f"$\\xi$ minus the centre of pressure [{face.units['xi']}]")
    for axes in panels:
        axes.set_ylabel(f"pressure [{face.units['pressure']}]")
    panels[0].legend(title="forward, $x$ =", title_fontsize=7, ncol=3, loc="upper center")


def chosen_steps(face, count):
    """Steps of the first forward stroke with contact, spread over x."""
    stroke = first_stroke(face.x, 1)
    stroke = stroke[face.pressure[stroke].max(axis=1) > 0] if len(stroke) else stroke
    if len(stroke) == 0:
        return []
    wanted = np.linspace(face.x[stroke[-1]] / count, face.x[stroke[-1]], count)
    return sorted({int(stroke[np.abs(face.x[stroke] - x).argmin()]) for x in wanted})


def centre_of_pressure(face, step):
    force = face.weight * face.pressure[step]
    return np.sum(force * face.xi) / np.sum(force)


def pressed_points(face, step):
    """The points under pressure and one more on either side."""
    pressed = np.flatnonzero(face.pressure[step] > 0)
    return slice(max(pressed[0] - 1, 0), pressed[-1] + 2)


def draw_widths(axes, result):
    axes.plot(result.table["x"], result.table["contact_width"], **look(0))
    set_labels(axes, result.units, "x", "contact_width")
    axes.set_ylim(bottom=0)


def draw_depths(axes, result):
    """The layer's compression and the numerical overlap, which should be far smaller."""
    for index, column in enumerate(("indentation", "penetration")):
        depth = result.table[column]
        axes.semilogy(result.table["x"], np.where(depth > 0, depth, np.nan), label=column, **look(index))
    set_labels(axes, result.units, "x", "penetration")
    axes.set_ylabel(f"depth [{result.units['penetration']}]")
    show_legend(axes)


# Sweeps of the slope


def slope_sweep(result):
    """The dimensionless slope over mu (Fig. 10 of the paper) or theta0 (Fig. 11)."""
    return slopes_over_coefficient([result]) if "mu" in result.table else slopes_over_inclination(result)


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
    figure, panels = slope_panels({**result.units, "theta0": "deg"}, "theta0")
    ratios = result.table["offset_ratio"]
    for axes, direction in zip(panels, ("forward", "backward")):
        for index, ratio in enumerate(np.unique(ratios)):
            rows = ratios == ratio
            theta0 = np.degrees(result.table["theta0"][rows])
            axes.plot(theta0, result.table[f"dimensionless_{direction}"][rows], label=f"{ratio:g}", **look(index))
        axes.set_xlim(left=0)
        axes.legend(title="$e/R$", title_fontsize=7)
    return figure


# Pictures into files

FORMATS = {"png", "pdf", "svg"}


def draw(results):
    """{picture name: figure} for one or several results."""
    if len(results) == 1 and is_map(results[0]):
        return {"map": stability_map(results[0])}
    if len(results) == 1 and is_study(results[0]):
        return study_pictures(results[0])
    if len(results) == 1 and is_calibration(results[0]):
        return {"calibration": calibration(results[0])}
    if len(results) == 1 and "P_fitted" in results[0].table:
        return {"contact-law": contact_law(results[0])}
    if len(results) == 1 and is_sprag_slip(results[0]):
        check_steps(results)
        return sprag_slip_pictures(results[0])
    if len(results) == 1 and "modes" in results[0].groups:
        return vibration_pictures(results[0])
    if len(results) == 1 and results[0].is_sweep:
        return {"slope": slope_sweep(results[0])}
    check_steps(results)
    pictures = {"forces-over-time": forces_over_time(results), "forces-over-x": forces_over_x(results)}
    return {**pictures, **(pictures_of_one(results[0]) if len(results) == 1 else {"comparison": comparison(results)})}


def check_steps(results):
    """Throws NotAResult where there are none that pictures could share."""
    for result in results:
        if result.is_sweep:
            raise NotAResult(f"{result.folder}: a sweep of the slope is drawn by itself")
        if len(result.table["time"]) == 0:
            reason = result.summary.get("status")
            raise NotAResult(f"{result.folder}: " + (f"no step was made: {reason}" if reason else "no step is finished yet"))


def pictures_of_one(result):
    pictures = {}
    if result.face is not None:
        pictures["contact"] = contact(result)
    if is_transient(result) and has_reversal(result):
        pictures["reversal"] = reversal(result)
    if is_transient(result) and result.has("energy_residual"):
        pictures["energy"] = energy(result)
    if has_sensors(result):
        pictures["sensors"] = sensor_forces(result)
    if has_pair(result):
        pictures["pair"] = pair_of_levers(result)
    return {**pictures, **picture_of_fields(result)}


def picture_of_fields(result):
    """Of the frame of the largest x. One that cannot be read, as while it is written, must not keep the others from being drawn."""
    try:
        return {"fields": fields(result)} if written_frames(result) else {}
    except NotAResult as error:
        print(f"plot.py: no picture of the fields: {error}", file=sys.stderr)
        return {}


def save(pictures, folder, formats=("png",), dpi=300):
    """Writes every figure in every format and says which."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, figure in pictures.items():
        for ending in formats:
            path = folder / f"{name}.{ending}"
            figure.savefig(path, dpi=dpi)
            print(path)
        plt.close(figure)


def read_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", metavar="DIR", type=Path, help="result folder, holding result.h5")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PICTURE_DIR|FILE",
        help="default: the only result folder, or the current one; FILE.png, .pdf or .svg: of several runs the comparison alone",
    )
    parser.add_argument("--format", default="png", help="png, pdf or svg, or several: png,pdf")
    options = parser.parse_args(arguments)
    options.format = options.format.split(",")
    unknown = set(options.format) - FORMATS
    if unknown:
        parser.error(f"unknown format {', '.join(sorted(unknown))}: png, pdf or svg")
    options.only = None
    if options.output and options.output.suffix[1:] in FORMATS and not options.output.is_dir():
        if len(options.folders) == 1:
            parser.error("a picture file goes with several result folders; a single one has several pictures")
        options.only = options.output
    if options.output is None:
        options.output = options.folders[0] if len(options.folders) == 1 else Path(".")
    return options


@script
def main(arguments=None):
    options = read_arguments(arguments)
    use_print_style()
    results = [read_result(folder) for folder in options.folders]
    if options.only:
        check_steps(results)
        save({options.only.stem: comparison(results)}, options.only.parent, (options.only.suffix[1:],))
    else:
        save(draw(results), options.output, options.format)


if __name__ == "__main__":
    sys.exit(main())
