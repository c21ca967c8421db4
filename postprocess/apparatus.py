# SPDX-License-Identifier: GPL-3.0-only
"""The device of a scene as it stands at some x: geometry, mesh at rest, forces."""

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

import numpy as np

from forces import first_stroke
from frames import read_frame
from sprag.parameters import parse
from sprag.program import RunFailed, run_scene
from sprag.results import NotAResult, read_result

# Changes for a run that makes the mesh of a scene and little else.
COARSE = {
    "Analysis/Type": "quasi-static",
    "Analysis/Model": "finite element",
    "Drive/Profile": "triangle",
    "Drive/Table": "",
    "Drive/Start": 0,
    "Drive/Stroke": 1,
    "Mesh/Face size": 2,
    "Output/Fields": "turning points",
}
CLOSED_FORM = {"Analysis/Type": "quasi-static", "Analysis/Model": "closed form"}


# Geometry


@dataclass
class Geometry:
    """Holds the positions of the parts, with the cylinder's path at y = 0: eqs. 8 and 9 of the paper."""

    radius: float
    offset: float
    pivot: np.ndarray
    x: float
    height_at_rest: float  # of the pivot, where a pair's cylinder is in the mirror plane

    @property
    def theta(self):
        return self.inclination(self.x, self.pivot[1])

    @property
    def theta_0(self):
        """Returns the inclination at which the spring is relaxed."""
        return self.inclination(0.0, self.height_at_rest)

    def inclination(self, x, height):
        """Returns the inclination at which the friction face touches the cylinder: (l - x) sin theta + h cos theta = R - e."""
        away = self.pivot[0] - x
        return np.arcsin((self.radius - self.offset) / np.hypot(away, height)) - np.arctan2(height, away)

    @property
    def along(self):
        """d, away from the pivot."""
        return axes_at(self.theta)[0]

    @property
    def across(self):
        """n, from the cylinder into the lever."""
        return axes_at(self.theta)[1]

    @property
    def s(self):
        return float((np.array((self.x, 0.0)) - self.pivot) @ self.along)

    @property
    def foot(self):
        """Returns the projection of the pivot on the line of the friction face."""
        return self.pivot + self.offset * self.across

    @property
    def contact(self):
        return self.pivot + self.s * self.along + self.offset * self.across

    def place(self, points, theta=None):
        """From lever axes, at another inclination if one is given."""
        along, across = axes_at(self.theta if theta is None else theta)
        return self.pivot + points[..., :1] * along + points[..., 1:] * across


def axes_at(theta):
    return np.array((-np.cos(theta), np.sin(theta))), np.array((np.sin(theta), np.cos(theta)))


@dataclass
class Forces:
    """On the lever; F along -d, Q along x."""

    P: float
    F: float
    Q: float


@dataclass
class Device:
    """Holds a mesh in lever axes with its parameters, and the forces if they are known."""

    name: str
    parameters: dict
    frame: object
    leaf: object
    forces: Optional[Forces] = None
    largest_x: Optional[float] = None  # of its drive

    def number(self, name):
        return self.parameters[name].number

    def text(self, name):
        return self.parameters[name].text

    @property
    def is_pair(self):
        return self.text("Mirrored pair/Type") == "full"

    @property
    def cylinder_height(self):
        """Returns the height of the cylinder's path above the mirror plane of a full pair."""
        return self.number("Mirrored pair/Cylinder offset") if self.is_pair else 0.0

    def geometry(self, x, side=1):
        """Returns the geometry of the first lever, or with side = -1 of the second in mirrored axes."""
        height = self.number("Geometry/Pivot height")
        pivot = np.array((self.number("Geometry/Pivot distance"), height - side * self.cylinder_height))
        return Geometry(self.number("Geometry/Cylinder radius"), self.number("Geometry/Interface offset"), pivot, x, height)

    def leaf_points(self, geometry):
        """Nodes of the leaf spring where it is clamped in the hub and bent by it."""
        return geometry.place(bent_leaf(self, geometry.theta - geometry.theta_0), geometry.theta_0)


# Sources of devices


def make_device(path, sprag, x):
    """Makes the device of a scene or a result, of a design the lever found. Throws NotAResult."""
    path = found_lever(path) or path
    with tempfile.TemporaryDirectory(prefix="sprag-device-") as temporary:
        temporary = Path(temporary)
        scene, meshed = path, temporary / "mesh"
        name = path.stem
        try:
            if path.is_dir():
                result = read_result(path)
                name = result.name
                scene = temporary / "scene.prm"
                scene.write_text(result.parameters, encoding="utf-8")
                if (path / "fields-mesh.h5").is_file():
                    meshed = path
            if meshed != path:
                run_scene(sprag, scene, meshed, COARSE)
        except RunFailed as error:
            raise NotAResult(str(error)) from error
        mesh = read_result(meshed)
        frame, leaf = read_frame(mesh)
        forces, parameters, largest = closed_form(sprag, scene, temporary / "closed form", x)
        return Device(name, {**parse(mesh.parameters), **parameters}, frame, leaf, forces, largest)


def found_lever(folder):
    """Returns the scene of the lever that a design found or came nearest with; None of other results."""
    return next((path for path in (folder / "design-best.prm", folder / "design-nearest.prm") if path.is_file()), None)


def closed_form(sprag, scene, folder, x):
    """Forces at x on the first way forward, the scene's parameters and its largest x; nothing where the closed form does not take it."""
    try:
        run_scene(sprag, scene, folder, CLOSED_FORM)
    except RunFailed:
        return None, {}, None
    result = read_result(folder)
    stroke = first_stroke(result.table["x"], 1)
    largest = float(np.nanmax(result.table["x"]))
    places = result.table["x"][stroke]
    if len(places) < 2 or not places[0] <= (largest if x is None else x) <= places[-1]:
        return None, parse(result.parameters), largest
    found = [float(np.interp(largest if x is None else x, places, result.table[name][stroke])) for name in "PFQ"]
    return Forces(*found), parse(result.parameters), largest


# Parts that are no mesh or not as the mesh is at rest


def bent_leaf(device, turned):
    """Nodes in axes of the lever at rest, bent as a beam that the hub turns, the joint as the scene has it."""
    nodes = device.leaf.nodes
    clamp, length = device.number("Leaf spring/Clamp distance"), device.number("Leaf spring/Length")
    u = np.clip((-nodes[:, 0] - clamp) / length, 0, 1)
    slope, shift = {
        "clamped": (u - 2 * u**2 + u**3, 1 - 3 * u**2 + 2 * u**3),
        "pinned": (u - 1.5 * u**2 + 0.5 * u**3, 1 - 1.5 * u**2 + 0.5 * u**3),
        "guided": (u - 0.5 * u**2, np.ones_like(u)),
    }[device.text("Leaf spring/Joint")]
    return nodes - np.column_stack((np.zeros_like(u), turned * (length * slope + clamp * shift)))


def connectors(device):
    """[(corners in lever axes, kind)] of force sensors and guide of a friction plate."""
    frame = device.frame
    if not frame.shown(["plate"]).any():
        return []
    back = frame.nodes[frame.shown(["plate"]), 1].max()
    front, half = back + device.number("Friction plate/Spacer"), device.number("Friction plate/Sensor length") / 2
    sensors = [float(text) for text in device.text("Friction plate/Sensors").split(",")]
    boxes = [(middle, half, "sensor") for middle in sensors]
    boxes.append((device.number("Friction plate/Guide"), 0.6 * half, "guide"))
    corners = ((-1, back), (1, back), (1, front), (-1, front))
    return [(np.array([(middle + side * width, eta) for side, eta in corners]), kind) for middle, width, kind in boxes]
