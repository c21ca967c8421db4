# SPDX-License-Identifier: GPL-3.0-only
"""The device of a result to scale as SVG, from its parameters alone; device.py draws a lever as it is meshed."""

import re

import numpy as np

from apparatus import Geometry
from sprag.parameters import slug

FILLS = {"cylinder": "#ececec", "lever": "#d7e3ee", "layer": "#c98f4a", "hub": "#c3ccd6"}
HUB = 10.0  # depth of the hub beyond the pivot [mm]
STABLE, UNSTABLE = "#0072b2", "#d55e00"


def device_svg(result, parameters):
    """Draws the device at its worst x if known, else the largest; of a design the best lever. A verdict over the stroke is drawn along the
    path of the cylinder's centre. Returns None without contact, and where another damper takes the place of the levers."""
    texts = {name: parameters[name].text for name in ("Analysis/Type", "Study/Type", "Isolation/Damper") if name in parameters}
    analysis = texts.get("Study/Type") if texts.get("Analysis/Type") == "study" else texts.get("Analysis/Type")
    if analysis == "isolation" and texts.get("Isolation/Damper") != "lever":
        return None

    def number(name):
        found = result.summary.get(slug(name))
        return float(found) if isinstance(found, float) else parameters[name].number

    try:
        radius, offset, distance, height = (number(f"Geometry/{name}") for name in ("Cylinder radius", "Interface offset", "Pivot distance", "Pivot height"))
        length, depth, layer = number("Lever/Length"), number("Lever/Depth"), number("Friction layer/Thickness")
        x = next((float(v) for v in (result.summary.get(n) for n in ("largest_pressure_x", "x")) if isinstance(v, float) and np.isfinite(v)), number("Drive/Stroke"))
    except (KeyError, TypeError):
        return None
    geometry = Geometry(radius, offset, np.array((distance, height)), x, height)
    if not all(np.isfinite((radius, offset, distance, height, length, depth, layer, x, geometry.theta))):
        return None
    return drawn(geometry, length, depth, layer, stretches(result.summary))


def stretches(summary):
    """{direction: [(from, to, colour), ...]} of a verdict over the stroke, x in mm; empty of other results."""
    found = {}
    for way in ("forward", "backward"):
        if np.isfinite(summary.get(f"largest_growth_rate_{way}", np.nan)) and summary["looked_to"] > summary["looked_from"]:
            unstable = re.findall(r"(\S+) to (\S+?)(?: mm|,|$)", str(summary.get(f"unstable_{way}", "")))
            found[way] = [(float(summary["looked_from"]), float(summary["looked_to"]), STABLE), *((float(a), float(b), UNSTABLE) for a, b in unstable)]
    return found


def drawn(geometry, length, depth, layer, verdict):
    back = geometry.offset + layer + depth
    parts = [
        circle("cylinder", (geometry.x, 0), geometry.radius, FILLS["cylinder"]),
        circle("rest", (0, 0), geometry.radius, "none", 'stroke-dasharray="2 2" '),
        box(geometry, "hub", -HUB, 0, 0, back),
        box(geometry, "lever", 0, length, geometry.offset + layer, back),
        box(geometry, "layer", 0, length, geometry.offset, geometry.offset + layer) if layer > 0 else "",
        circle("pivot", geometry.pivot, 2.5, "white"),
        circle("contact", geometry.contact, 1.2, "black"),
    ]
    corners = np.array([geometry.place(np.array(corner)) for corner in ((-HUB, 0.0), (-HUB, back), (length, geometry.offset), (length, back))])
    low = np.minimum(corners.min(axis=0), (-geometry.radius, -geometry.radius)) - 12
    high = np.maximum(corners.max(axis=0), (geometry.x + geometry.radius, geometry.radius)) + 12
    size = 0.02 * (high[0] - low[0])
    above = f"depth {depth:.4g} mm, layer {layer:.4g} mm, e = {geometry.offset:.4g} mm, \N{GREEK SMALL LETTER THETA} = {np.degrees(geometry.theta):.3g}\N{DEGREE SIGN}"
    below = f"R = {geometry.radius:.4g} mm, l = {geometry.pivot[0]:.4g} mm, h = {geometry.pivot[1]:.4g} mm, x = {geometry.x:.4g} mm"
    words = ((high[1] - size, above), (low[1] + 0.3 * size, below))
    middle = 0.5 * (low[0] + high[0])
    path = f'<line x1="{low[0]:.1f}" x2="{high[0]:.1f}" y1="0" y2="0" stroke="#888" stroke-width="0.4" stroke-dasharray="8 2 1.5 2"/>'
    texts = "".join(f'<text x="{middle:.1f}" y="{-up:.1f}" text-anchor="middle" font-size="{size:.1f}">{text}</text>' for up, text in words)
    view = f"{low[0]:.1f} {-high[1]:.1f} {high[0] - low[0]:.1f} {high[1] - low[1]:.1f}"
    for way, up in (("forward", 0.7 * size), ("backward", -0.7 * size)):
        for begin, end, colour in verdict.get(way, ()):
            parts.append(f'<line class="verdict" x1="{begin:.2f}" x2="{end:.2f}" y1="{-up:.2f}" y2="{-up:.2f}" stroke="{colour}" stroke-width="{0.35 * size:.2f}"/>')
        if way in verdict:
            arrow = "\N{RIGHTWARDS ARROW} out" if way == "forward" else "\N{LEFTWARDS ARROW} back"
            texts += f'<text x="{verdict[way][0][1] + 0.4 * size:.1f}" y="{0.3 * size - 1.4 * up:.1f}" font-size="{0.8 * size:.1f}">{arrow}</text>'
    if verdict:
        worst = any(colour == UNSTABLE for lines in verdict.values() for _, _, colour in lines)
        note = "orange: where the slide is not stable" if worst else "blue: stable on all of it"
        texts += f'<text x="{middle:.1f}" y="{1.5 * size - low[1] - 2.8 * size:.1f}" text-anchor="middle" font-size="{0.8 * size:.1f}">path of the centre; {note}</text>'
    return f'<svg class="device" xmlns="http://www.w3.org/2000/svg" viewBox="{view}" role="img">{path}{"".join(parts)}{texts}</svg>'


def circle(name, centre, radius, fill, more=""):
    return f'<circle class="{name}" cx="{centre[0]:.3f}" cy="{-centre[1]:.3f}" r="{radius:.3f}" fill="{fill}" {more}stroke="#333" stroke-width="0.5"/>'


def box(geometry, name, begin, end, low, high):
    """A rectangle in lever axes."""
    corners = geometry.place(np.array(((begin, low), (end, low), (end, high), (begin, high))))
    points = " ".join(f"{x:.3f},{-y:.3f}" for x, y in corners)
    return f'<polygon class="{name}" points="{points}" fill="{FILLS[name]}" stroke="#333" stroke-width="0.5"/>'
