# SPDX-License-Identifier: GPL-3.0-only
"""Draws what technical drawings are made of: dimensions, angles, springs, outlines. Everything in the units of the axes."""

import numpy as np
from matplotlib.path import Path
from matplotlib.patches import Arc, PathPatch

THIN = {"color": "0.25", "linewidth": 0.6}
HIDDEN = {"color": "0.45", "linewidth": 0.6, "linestyle": (0, (4, 2))}
CENTRE_LINE = {"color": "0.45", "linewidth": 0.5, "linestyle": (0, (9, 2, 2, 2))}
PLATE = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}  # behind a text that lies on lines


def dimension(axes, begin, end, text, offset=(0, 0), share=0.5, words=None, **style):
    """An arrow with two heads between two points moved by an offset, with thin lines to the points themselves.

    The text stands at a share of the arrow; `words`: how it is written.
    """
    begin, end, offset = (np.asarray(point, dtype=float) for point in (begin, end, offset))
    if np.any(offset):
        for point in (begin, end):
            axes.plot(*np.transpose((point, point + 1.04 * offset)), **{**THIN, "linewidth": 0.4}, gid="extension")
    arrow = {"arrowstyle": "<|-|>", "shrinkA": 0, "shrinkB": 0, "linewidth": 0.6, "mutation_scale": 6, "color": "0.15"}
    axes.annotate("", end + offset, begin + offset, arrowprops={**arrow, **style}, zorder=8)
    note(axes, text, begin + share * (end - begin) + offset, **(words or {}))


def note(axes, text, place, away=(0, 0), **style):
    """A text moved from a place by so many points."""
    own = {"ha": "center", "va": "center", "fontsize": 8, "bbox": PLATE, "zorder": 9, **style}
    axes.annotate(text, place, xytext=away, textcoords="offset points", **own)


def pointer(axes, text, place, at, **style):
    """A name with a thin line to what it is the name of."""
    line = {"arrowstyle": "-", "linewidth": 0.5, "color": "0.25", "shrinkA": 1, "shrinkB": 0}
    own = {"ha": "center", "va": "center", "fontsize": 7.5, "zorder": 9, **style}
    axes.annotate(text, place, xytext=at, arrowprops=line, **own)


def force(axes, begin, vector, text, colour, away, gid, ha="left"):
    """An arrow as long as the vector, named beside its tip."""
    begin, vector = np.asarray(begin, dtype=float), np.asarray(vector, dtype=float)
    arrow = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0, "linewidth": 1.6, "mutation_scale": 11, "color": colour}
    axes.annotate("", begin + vector, begin, arrowprops=arrow, zorder=10, gid=gid)
    note(axes, text, begin + vector, away, color=colour, zorder=11, ha=ha)


def angle(axes, corner, radius, begin, end, text, away=(-4, 0), **style):
    """An arc between two directions [rad], counted against the clock, named at its end."""
    low, high = np.degrees(sorted((begin, end)))
    axes.add_patch(Arc(corner, 2 * radius, 2 * radius, theta1=low, theta2=high, linewidth=0.8, color="0.15", zorder=8))
    middle = (begin + end) / 2
    place = np.asarray(corner) + radius * np.array((np.cos(middle), np.sin(middle)))
    note(axes, text, place, away, **{"ha": "right", **style})


def outline(axes, points, edges, **style):
    """Fills what lies to the left of directed edges, numbers of points; a hole is what its edges go round the other way."""
    vertices, codes = [], []
    for loop in find_loops(edges, points):
        vertices += [*points[loop], points[loop[0]]]
        codes += [Path.MOVETO, *[Path.LINETO] * (len(loop) - 1), Path.CLOSEPOLY]
    if vertices:
        axes.add_patch(PathPatch(Path(vertices, codes), **style))


def find_loops(edges, points):
    """Chains of the edges' first points; points at the same place are one."""
    keys = [tuple(key) for key in np.round(points, 5) + 0.0]
    following = {}
    for first, second in edges:
        following.setdefault(keys[first], []).append((first, second))
    loops = []
    while following:
        key = next(iter(following))
        loop = []
        while key in following:
            first, second = following[key].pop()
            if not following[key]:
                del following[key]
            loop.append(first)
            key = keys[second]
        loops.append(loop)
    return loops


def spiral(axes, centre, radius, turns=2.75, **style):
    """A torsional spring about a point."""
    along = np.linspace(0, 1, 200)
    phase = 2 * np.pi * turns * along
    reach = radius * (0.25 + 0.75 * along)
    axes.plot(centre[0] + reach * np.cos(phase), centre[1] + reach * np.sin(phase), **style)


def zigzag(axes, begin, end, height, coils=5, **style):
    """A spring between two points."""
    begin, end = np.asarray(begin, dtype=float), np.asarray(end, dtype=float)
    along = (end - begin) / np.linalg.norm(end - begin)
    across = np.array((-along[1], along[0]))
    share = np.concatenate(([0, 0.15], np.linspace(0.2, 0.8, 2 * coils), [0.85, 1]))
    side = np.concatenate(([0, 0], np.resize((1, -1), 2 * coils), [0, 0])) * height / 2
    axes.plot(*(begin + share[:, None] * (end - begin) + side[:, None] * across).T, **style)


def ground(axes, begin, end, depth, **style):
    """A hatched line, on whose right side what it belongs to stands still."""
    begin, end = np.asarray(begin, dtype=float), np.asarray(end, dtype=float)
    along = (end - begin) / np.linalg.norm(end - begin)
    right = np.array((along[1], -along[0]))
    axes.plot(*np.transpose((begin, end)), **{"color": "black", "linewidth": 1, **style})
    for share in np.linspace(0, 1, max(3, int(np.linalg.norm(end - begin) / depth))):
        foot = begin + share * (end - begin)
        axes.plot(*np.transpose((foot, foot + depth * (right - along))), color="black", linewidth=0.5)
