# SPDX-License-Identifier: GPL-3.0-only
"""Reads the frames of displacement and stress that sprag writes beside result.h5, and where the apparatus stood in each."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from sprag.results import WAYS, NotAResult, read_fields

# The numbers of parts are those that FieldFrames writes.
PARTS = {1: "lever", 2: "layer", 3: "hub", 4: "web", 5: "plate", 6: "cylinder", 7: "leaf"}
NUMBERS = {name: number for number, name in PARTS.items()}
MOVED = ("displacement", "elastic_displacement", "von_mises_stress")  # of a frame


@dataclass
class Frame:
    """One written frame: quadrilaterals, p x p of them in a cell of degree p. Cells of a part share nodes."""

    nodes: np.ndarray  # [n x 2]
    quads: np.ndarray  # [m x 4] node numbers, counted clockwise in lever axes
    displacement: np.ndarray  # [n x 2]
    stress: np.ndarray  # von Mises [n]
    part: np.ndarray  # names [n]
    degree: int

    @cached_property
    def outlines(self):
        """Node numbers around each cell [cells x 4 p]."""
        grid = self.quads.reshape(-1, self.degree, self.degree, 4)
        return np.concatenate((grid[:, 0, :, 0], grid[:, :, -1, 3], grid[:, -1, ::-1, 2], grid[:, ::-1, 0, 1]), axis=1)

    @cached_property
    def cell_part(self):
        return self.part[self.outlines[:, 0]]

    def shown(self, names):
        """Which nodes belong to those parts."""
        return any_of(self.part, names)

    @cached_property
    def places(self):
        """A number of the place of each node."""
        return np.unique(np.round(self.nodes, 6) + 0.0, axis=0, return_inverse=True)[1].reshape(-1)

    def borders(self, names=tuple(PARTS.values())):
        """Node numbers of the edges between parts and on the outside of those named [edges x 2]."""
        cells = self.outlines[any_of(self.cell_part, names)]
        edges = np.stack((cells, np.roll(cells, -1, axis=1)), axis=-1).reshape(-1, 2)
        if len(edges) == 0:
            return edges
        part = np.select([self.part == name for name in NUMBERS], list(NUMBERS.values()))[edges[:, 0]]
        low, high = np.sort(self.places[edges], axis=1).T
        keys = (part * len(self.nodes) + low) * len(self.nodes) + high
        _, index, counts = np.unique(keys, return_index=True, return_counts=True)
        return edges[index[counts == 1]]


def any_of(words, names):
    """Which of an array of words are among the names."""
    return np.any([words == name for name in names], axis=0)


def every_cell(mesh):
    """Returns the cells with those of rigid parts, where there are such."""
    return np.concatenate([mesh[name] for name in ("cells", "rigid_cells") if name in mesh]).astype(int)


def read_frame(result, path=None, row=None):
    """The first lever and its leaf spring (None without) as they are in a frame, in lever axes; without a path undeformed.

    A leaf spring is in the axes of the lever at rest, its displacement includes the hub's rotation. Nodes of an elastic cylinder
    are about its centre.
    """
    names = {"nodes", "part", "lever", "cells", "rigid_cells", *(MOVED if path else ())}
    mesh = {name: np.asarray(values) for name, values in read_fields(result.folder, path, names=names).items()}
    if missing := names - set(mesh) - {"rigid_cells"}:
        raise NotAResult(f"{path or result.folder}: cannot be read as fields of this version of sprag (no {', '.join(sorted(missing))})")
    moved = [np.broadcast_to(mesh[name], (len(mesh["nodes"]), 3))[:, :2] if path else np.zeros((len(mesh["nodes"]), 2)) for name in MOVED[:2]]
    stress = mesh["von_mises_stress"] if path else np.zeros(len(mesh["nodes"]))
    part = mesh["part"].round().astype(int)
    is_first = mesh["lever"] == 1
    all_quads = every_cell(mesh)

    rest = pose(result)
    stands = rest if row is None else pose(result, row)
    up = np.array((0.0, cylinder_height(result)))
    nodes = mesh["nodes"][:, :2] - up
    cylinder = (part == NUMBERS["cylinder"])[:, None]
    in_lever = np.round(np.where(cylinder, rest.along_axes(nodes), rest.in_axes(nodes)), 9) + 0.0
    names = np.array([PARTS.get(index, "") for index in range(max(PARTS) + 1)])[part]

    def only(which, displacement, degree):
        kept = np.flatnonzero(which)
        if len(kept) == 0:
            return None
        quads = all_quads[which[all_quads[:, 0]]]
        return Frame(in_lever[kept], np.searchsorted(kept, quads), displacement[kept], stress[kept], names[kept], degree)

    leaf = part == NUMBERS["leaf"]
    bent = rest.along_axes(nodes + moved[0] - stands.pivot) - in_lever
    return only(is_first & ~leaf, stands.along_axes(moved[1]), int(number(result, "Mesh", "Degree"))), only(is_first & leaf, bent, 2)


@dataclass
class Pose:
    """Holds the position of the apparatus: x along the cylinder's path towards the pivot, y up from that path."""

    x: float  # of the cylinder's centre, which has y = 0
    pivot: np.ndarray
    theta: float  # of the lever at its hub

    def centre(self):
        """Returns the cylinder's centre in lever axes."""
        return self.in_axes(np.array((self.x, 0.0)))

    def in_axes(self, points):
        """Lever coordinates of places."""
        return self.along_axes(points - self.pivot)

    def along_axes(self, vectors):
        """Components along and across the lever."""
        along, across = np.array((-np.cos(self.theta), np.sin(self.theta))), np.array((np.sin(self.theta), np.cos(self.theta)))
        return np.stack((vectors @ along, vectors @ across), axis=-1)

    def place(self, points, theta=None):
        """From axes at the pivot, inclined by theta (the lever's unless given), [n x 2]."""
        angle = self.theta if theta is None else theta
        along, across = np.array((-np.cos(angle), np.sin(angle))), np.array((np.sin(angle), np.cos(angle)))
        return self.pivot + points[..., :1] * along + points[..., 1:] * across


def pose(result, row=None):
    """Returns the pose of one row of the table; without a row that at rest."""
    table = result.table
    moved = table["support_displacement"][row] if row is not None and result.has("support_displacement") else 0.0
    height = number(result, "Geometry", "Pivot height") - cylinder_height(result)
    pivot = np.array((number(result, "Geometry", "Pivot distance") + moved, height))
    return Pose(0.0, pivot, rest_inclination(result)) if row is None else Pose(table["x"][row], pivot, table["theta"][row])


def cylinder_height(result):
    """Returns the height of the cylinder's path above the mirror plane y = 0 of a full pair."""
    try:
        full = result.parameter("Mirrored pair", "Type") == "full"
    except KeyError:
        return 0.0
    return number(result, "Mirrored pair", "Cylinder offset", 0.0) if full else 0.0


def rest_inclination(result):
    """theta_0, where the cylinder touches the unloaded lever at x = 0 (eq. 9 of the paper)."""
    distance, height, radius, offset = (
        number(result, "Geometry", name) for name in ("Pivot distance", "Pivot height", "Cylinder radius", "Interface offset")
    )
    return np.arcsin((radius - offset) / np.hypot(distance, height)) - np.arctan2(height, distance)


def number(result, section, name, otherwise=None):
    """A parameter; `otherwise`, unless None, where there is none."""
    try:
        return float(result.parameter(section, name))
    except KeyError:
        if otherwise is None:
            raise
        return otherwise


@dataclass
class Written:
    """A frame that is there to be chosen."""

    file: Path
    time: float  # as the index gives it, to six places
    row: int  # of the table
    x: float
    way: int  # 1 forward, -1 backward; a turning point belongs to the stroke that led to it


def written_frames(result):
    """Returns the written frames of a run in which the cylinder moves."""
    if "modes" in result.groups:
        raise NotAResult(f"{result.folder}: its frames are modes, which plot.py draws along the face and ParaView shows (mode-01.xdmf, ...)")
    if len(result.table.get("time", ())) == 0:
        return []
    x, times = result.table["x"], result.table["time"]
    found = [(file, time, int(np.abs(times - time).argmin())) for time, file in result.frames if file.is_file()]
    return [Written(file, time, row, x[row], result.ways[row]) for file, time, row in found]


def chosen_frame(result, x=None, way=None):
    """The frame nearest to x, that of the largest P where none is asked for. Throws NotAResult where there is none near."""
    frames = written_frames(result)
    candidates = [frame for frame in frames if way is None or frame.way == WAYS[way]]
    if not frames:
        raise NotAResult(f"{result.folder}: no frames of fields there; Output/Fields must not be none, and Analysis/Model be meshed")
    interval = result.parameter("Output", "Field interval")
    near = (np.abs(np.diff(result.table["x"])).sum() / 20 if interval == "auto" else float(interval)) / 2
    if x is None and candidates:
        return max(candidates, key=lambda frame: result.table["P"][frame.row])
    nearest = min(candidates, key=lambda frame: abs(frame.x - x), default=None)
    if nearest is None or abs(nearest.x - x) > near:
        request = " ".join(filter(None, (f"at x = {x:g} mm" if x is not None else "", way)))
        raise NotAResult(f"{result.folder}: no frame {request}: there are {listed(frames)}; {how_to_get_more(result)}")
    return nearest


def listed(frames):
    """The x there are, each way."""
    texts = []
    for name, sign in WAYS.items():
        there = list(dict.fromkeys(f"{frame.x:.4g}" for frame in frames if frame.way == sign))
        if there:
            texts.append(f"{name} x = {', '.join(there)} mm")
    return " and ".join(texts)


def how_to_get_more(result):
    if result.parameter("Output", "Fields") == "interval":
        return "a smaller Output/Field interval writes more"
    return "Output/Fields = interval writes one each Output/Field interval"
