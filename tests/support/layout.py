# SPDX-License-Identifier: GPL-3.0-only
"""Finds the problems of layout in a drawn figure of matplotlib, and says them in words."""

from itertools import combinations

import numpy as np
from matplotlib.collections import Collection
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

TOUCHING = 0.7  # points by which boxes of texts may overlap: they have a margin of their own
COVERED = 0.05  # of a curve's drawn length or of its points that a legend may cover
ROUND_OFF = 1e-7  # range of a linear axis, in its unit (mm, N, s, rad), below which it shows round-off


def problems(figure):
    """A sentence for each thing that is wrong; empty for a good figure. Draws the figure."""
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    shown = [axes for axes in figure.axes if axes.get_visible()]
    found = []
    for number, axes in enumerate(shown, 1):
        name = f"panel {number} ({said(axes)})"
        found += [f"{name}: {text}" for text in (*emptiness(axes), *round_off(axes), *covered_curves(axes, renderer))]
    boxes = text_boxes(figure, shown, renderer)
    return found + overlaps(boxes, figure) + outside(figure, shown, boxes, renderer) + covered_panels(figure, shown, renderer)


def said(axes):
    words = axes.get_title(loc="left"), axes.get_ylabel(), axes.get_xlabel()
    return " ".join(word for word in words if word).replace("\n", " ") or "without words"


def is_colour_bar(axes):
    return axes.get_label() == "<colorbar>" or hasattr(axes, "_colorbar")


# Panels without data


def emptiness(axes):
    if is_colour_bar(axes) or not axes.axison:
        return []
    if any(text.get_text() and text.get_visible() for text in axes.texts if not has_arrow_alone(text)):
        return []
    return [] if any(holds_data(axes, artist) for artist in axes.get_children()) else ["holds no data"]


def has_arrow_alone(text):
    return isinstance(text, Annotation) and not text.get_text()


def holds_data(axes, artist):
    """Tells if some of a line, bar, mesh or image lies within the panel; lines across the whole panel are no data."""
    if not artist.get_visible() or artist is axes.patch:
        return False
    if hasattr(artist, "get_xydata"):
        return artist.get_transform() == axes.transData and bool(within(axes, artist.get_path().vertices).any())
    if isinstance(artist, Collection):
        return len(artist.get_paths()) > 0 or artist.get_array() is not None
    return artist in axes.patches or artist in axes.images


def within(axes, points):
    (left, right), (low, high) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    x, y = np.asarray(points, dtype=float).reshape(-1, 2).T
    return (x >= left) & (x <= right) & (y >= low) & (y <= high)


# Axes that show nothing but round-off


def round_off(axes):
    if is_colour_bar(axes) or not axes.axison:
        return []
    found = []
    for name, axis in (("abscissa", axes.xaxis), ("ordinate", axes.yaxis)):
        low, high = axis.get_view_interval()
        if axis.get_scale() == "linear" and abs(high - low) < max(ROUND_OFF, 1e-9 * abs(low), 1e-9 * abs(high)):
            found.append(f"the {name} from {low:g} to {high:g} shows round-off")
    return found


# Texts


def text_boxes(figure, shown, renderer):
    """[(text, box)] of all texts that are drawn."""
    texts = [text for text in figure.texts if text.get_text().strip()]
    if figure._suptitle is not None and figure._suptitle.get_text().strip():
        texts.append(figure._suptitle)
    for legend in figure.legends:
        texts += legend_texts(legend)
    for axes in shown:
        texts += [text for text in (axes.title, axes._left_title, axes._right_title, *axes.texts)]
        if axes.get_legend() is not None:
            texts += legend_texts(axes.get_legend())
        if axes.axison:
            for axis in (axes.xaxis, axes.yaxis):
                texts += [axis.label, axis.get_offset_text(), *drawn_tick_labels(axis)]
    drawn = {id(text): text for text in texts if text.get_visible() and text.get_text().strip()}
    boxes = [(" ".join(text.get_text().split()), text_box(text, renderer)) for text in drawn.values()]
    return [(text, box) for text, box in boxes if box.width > 0 and box.height > 0]


def text_box(text, renderer):
    """Returns the box of the text alone, without the arrow of an annotation."""
    if isinstance(text, Annotation):
        text.update_positions(renderer)
        return super(Annotation, text).get_window_extent(renderer)
    return text.get_window_extent(renderer)


def legend_texts(legend):
    return [legend.get_title(), *legend.get_texts()] if legend.get_visible() else []


def drawn_tick_labels(axis):
    return [label for tick in axis._update_ticks() for label in (tick.label1, tick.label2)]


def overlaps(boxes, figure):
    margin = TOUCHING * figure.dpi / 72
    found = []
    for (one, first), (other, second) in combinations(boxes, 2):
        width = min(first.x1, second.x1) - max(first.x0, second.x0)
        height = min(first.y1, second.y1) - max(first.y0, second.y0)
        if width > margin and height > margin:
            found.append(f"'{one}' lies over '{other}'")
    return found


# The page


def outside(figure, shown, boxes, renderer):
    """Returns a message for everything that the edge of the page cuts."""
    boxes = list(boxes)
    legends = [*figure.legends, *(axes.get_legend() for axes in shown if axes.get_legend() is not None)]
    boxes += [("a legend", legend_contents(legend, renderer)) for legend in legends]
    boxes += [(f"the panel {said(axes)}", axes.get_window_extent(renderer)) for axes in shown]
    page, half = figure.bbox, 0.5 * figure.dpi / 72
    return [
        f"'{text}' is cut by the edge of the page"
        for text, box in boxes
        if box.x0 < page.x0 - half or box.y0 < page.y0 - half or box.x1 > page.x1 + half or box.y1 > page.y1 + half
    ]


# Legends


def legend_contents(legend, renderer):
    """Without the margin around."""
    boxes = [text.get_window_extent(renderer) for text in legend_texts(legend) if text.get_text()]
    handles = legend.legend_handles if hasattr(legend, "legend_handles") else legend.legendHandles  # before matplotlib 3.7
    boxes += [handle.get_window_extent(renderer) for handle in handles if handle is not None]
    boxes = [box for box in boxes if np.isfinite(box.extents).all() and box.width + box.height > 0]
    return Bbox.union(boxes) if boxes else legend.get_window_extent(renderer)


def covered_curves(axes, renderer):
    """Curves and bars of which the legend hides too much."""
    legend = axes.get_legend()
    if legend is None or not legend.get_visible():
        return []
    box = legend_contents(legend, renderer)
    found = []
    for line in (line for line in axes.lines if line.get_transform() == axes.transData):
        inside = covered_share(axes, line, box)
        if inside > COVERED:
            found.append(f"the legend covers {100 * inside:.0f} % of '{line.get_label()}'")
    for bar in axes.patches:
        extent = bar.get_window_extent(renderer)
        overlap = Bbox.intersection(extent, box)
        if overlap is not None and overlap.width * overlap.height > 0.25 * extent.width * extent.height > 0:
            found.append("the legend covers a bar")
    return found


def covered_share(axes, line, box):
    """Returns the covered share of the drawn length of a line, or of the points of one with markers alone."""
    points = line.get_transform().transform(line.get_path().vertices)
    points = points[np.isfinite(points).all(axis=1)]
    panel = axes.bbox
    if len(points) == 0:
        return 0.0
    if line.get_linestyle() != "None" and len(points) > 1:
        lengths = np.hypot(*np.diff(points, axis=0).T)
        if not lengths.sum() > 0:
            return 0.0
        path = np.concatenate(([0], np.cumsum(lengths)))
        even = np.linspace(0, path[-1], 2000)
        points = np.column_stack([np.interp(even, path, values) for values in points.T])
    drawn = is_inside(panel, points)
    return float((drawn & is_inside(box, points)).sum() / max(drawn.sum(), 1))


def is_inside(box, points):
    return (points[:, 0] > box.x0) & (points[:, 0] < box.x1) & (points[:, 1] > box.y0) & (points[:, 1] < box.y1)


def covered_panels(figure, shown, renderer):
    """Panels that lie under one another or under a legend of the whole figure."""
    panels = [(f"the panel {said(axes)}", axes.get_window_extent(renderer)) for axes in shown]
    legends = [("the legend of the figure", legend_contents(legend, renderer)) for legend in figure.legends]
    found = []
    for (one, first), (other, second) in [*combinations(panels, 2), *((legend, panel) for legend in legends for panel in panels)]:
        overlap = Bbox.intersection(first, second)
        if overlap is not None and min(overlap.width, overlap.height) > 1:
            found.append(f"{one} lies over {other}")
    return found
