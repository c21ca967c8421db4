# SPDX-License-Identifier: GPL-3.0-only
"""The contact of a run of finite elements: pressure along the friction face each way, its width, and how deep the cylinder goes."""

import numpy as np

from style import COLOURS, MARKERS, MILLIMETRE, TWO_COLUMNS, legend_on_top, look, panel_letter, plt, set_labels, show_legend

WAYS = {1: ("forward", "-"), -1: ("backward", (0, (3, 1.2)))}
COUNT = 5  # positions of the cylinder of which the pressure is shown
TURN = 0.005  # travel behind a reversal in which the worst state is taken, over the largest x


def contact(result):
    """Pressure at a few x, along the face and about its own centre, of each way there is; contact width and depths over x."""
    chosen = chosen_states(result)
    ways = [way for way in WAYS if any(state[1] == way for state in chosen)]
    rows = 3 if ways else 1
    figure = plt.figure(figsize=(TWO_COLUMNS, (6 + 53 * rows) * MILLIMETRE))
    grid = figure.add_gridspec(rows, 2)
    panels = []
    if ways:
        panels.append(figure.add_subplot(grid[0, :]))
        panels += [figure.add_subplot(grid[1, index] if len(ways) == 2 else grid[1, :]) for index in range(len(ways))]
        draw_along_face(panels[0], result.friction_face, chosen)
        for axes, way in zip(panels[1:], ways):
            draw_about_centre(axes, result.friction_face, [state for state in chosen if state[1] == way])
            top = panels[0].get_ylim()[1]
            axes.set_ylim(-0.04 * top, top)
        figure_legend(figure, result.friction_face, chosen)
    widths, depths = (figure.add_subplot(grid[rows - 1, column]) for column in range(2))
    draw_widths(widths, result)
    draw_depths(depths, result)
    words = ["along the face: forward solid, backward dashed" if len(ways) == 2 else "along the face", *(WAYS[way][0] for way in ways)]
    for axes, letter, text in zip((*panels, widths, depths), "abcde", [*words[: len(panels)], "", ""]):
        panel_letter(axes, letter)
        if text:
            axes.set_title(f"({letter}) {text}", loc="left", fontsize=8)
    return figure


# Which states


def chosen_states(result, count=COUNT):
    """[(row of the face's steps, way, number of the position)] of states in contact, spread over x, the same x each way."""
    face, ways = result.friction_face, find_state_ways(result)
    pressed = np.flatnonzero(result.table["P"][find_state_rows(result)] > 0)
    if len(pressed) == 0:
        return []
    places = positions(face.x[pressed], count)
    near = np.diff(places).min(initial=np.inf) / 2
    found = []
    for way in WAYS:
        rows = first_stroke(pressed, ways, way)
        for number, x in enumerate(places):
            away = np.abs(face.x[rows] - x)
            if len(rows) and away.min() <= near:
                # Behind the reversal at the largest x the contact sticks, and is pressed most once it slides.
                reach = max(away.min(), TURN * x if x == places[-1] else 0)
                found.append((int(max(rows[away <= reach], key=lambda row: face.pressure[row].max())), way, number))
    return [state for state in found if (face.pressure[state[0]] > 0).any()]


def positions(x, count):
    """Returns `count` positions from the smallest x to the largest, or all of x if there are fewer."""
    far = x.max()
    apart = [x.min()]
    for value in np.sort(x):
        if value - apart[-1] > 0.02 * abs(far):
            apart.append(value)
    apart[-1] = far if far - apart[-1] <= 0.02 * abs(far) else apart[-1]
    return np.array(apart) if len(apart) <= count else np.linspace(max(x.min(), far / count), far, count)


def find_state_rows(result):
    """Returns the rows of the table at which the face was recorded."""
    return result.friction_face.find_rows(result.table["time"])


def find_state_ways(result):
    """1 forward, -1 backward; a turning point belongs to the stroke that led to it."""
    return result.ways[find_state_rows(result)]


def first_stroke(rows, ways, way):
    """Returns the rows of the first stroke that way; later ones repeat it."""
    stroke_rows = rows[ways[rows] == way]
    if len(stroke_rows) == 0:
        return stroke_rows
    changed = np.flatnonzero(ways[stroke_rows[0] :] != way)
    end = stroke_rows[0] + changed[0] if len(changed) else len(ways)
    return stroke_rows[stroke_rows < end]


def pressure_centre(face, step):
    force = face.weight * face.pressure[step]
    return np.sum(force * face.xi) / np.sum(force)


def pressed_points(face, step):
    """The points under pressure and one more on either side."""
    pressed = np.flatnonzero(face.pressure[step] > 0)
    return slice(max(pressed[0] - 1, 0), pressed[-1] + 2)


# The panels


def draw_along_face(axes, face, chosen):
    for step, way, number in chosen:
        patch = pressed_points(face, step)
        axes.plot(face.xi[patch], face.pressure[step][patch], color=COLOURS[number], linestyle=WAYS[way][1], linewidth=1)
    axes.set_ylim(bottom=0)
    axes.set_xlabel(f"lever coordinate $\\xi$ [{face.xi.unit}]")
    axes.set_ylabel(f"pressure [MPa]")


def draw_about_centre(axes, face, chosen):
    for step, way, number in chosen:
        patch = pressed_points(face, step)
        xi, pressure, centre = face.xi[patch], face.pressure[step][patch], pressure_centre(face, step)
        line_look = {"color": COLOURS[number], "linestyle": WAYS[way][1], "marker": MARKERS[number], "markersize": 2}
        axes.plot(xi - centre, pressure, linewidth=0.8, **line_look)
    axes.set_xlabel(f"$\\xi$ minus the centre of pressure [{face.xi.unit}]")
    axes.set_ylabel(f"pressure [MPa]")


def figure_legend(figure, face, chosen):
    names = {number: f"x = {face.x[step]:.3g} {face.x.unit}" for step, _, number in reversed(chosen)}
    numbers = sorted(names)
    handles = [plt.Line2D([], [], color=COLOURS[number], marker=MARKERS[number], markersize=3) for number in numbers]
    legend_on_top(figure, handles, [names[number] for number in numbers])


def draw_widths(axes, result):
    axes.plot(result.table["x"], result.table["contact_width"], **look(0))
    set_labels(axes, result.units, "x", "contact_width")
    axes.set_ylim(bottom=0)


def draw_depths(axes, result):
    """The layer's compression and the numerical overlap, which should be far smaller."""
    for index, column in enumerate(("indentation", "penetration")):
        depth = result.table[column]
        if np.nanmax(depth, initial=0) > 0:
            axes.semilogy(result.table["x"], np.where(depth > 0, depth, np.nan), label=column, **look(index))
    set_labels(axes, result.units, "x", "penetration")
    axes.set_ylabel(f"depth [{result.units['penetration']}]")
    show_legend(axes)
