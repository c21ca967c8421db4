#!/usr/bin/python3
"""Draws meshes: of a result folder of sprag (with fields), or of a gmsh .msh file in ASCII, version 2.2 or 4.1."""

import argparse
import sys
from pathlib import Path

import h5py
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

import plot
from results import NotAResult, read_result

import matplotlib.pyplot as plt  # isort: skip (plot chooses what draws)

FILLS = {"lever": "#cfe2f3", "web": "#9fc5e8", "plate": "#b6d7a8", "layer": "#e8c28c", "hub": "#bfbfbf", "": "white"}
HALF_WIDTH = 6.0  # mm shown in the zoom to each side
DPI = 150


class Mesh:
    """Polygons by part, the friction face, and where to look closely."""

    def __init__(self, name):
        self.name = name
        self.parts = {}  # a name of FILLS -> [cells x vertices x 2]
        self.face = np.empty((0, 2, 2))  # segments
        self.centre = None  # of the zoom, along the lever
        self.circle = None  # centre x, centre y, radius of the cylinder


def outlines(cells, per_cell):
    """Vertex numbers around groups of `per_cell` consecutive quadrilaterals: a cell of degree p is written in p x p pieces."""
    result = []
    for group in cells.reshape(-1, per_cell, 4):
        edges = {}
        for quad in group:
            for a, b in zip(quad, np.roll(quad, -1)):
                if (b, a) in edges:
                    del edges[(b, a)]
                else:
                    edges[(a, b)] = b
        following = {a: b for a, b in edges}
        around = [next(iter(following))]
        while len(around) < len(following):
            around.append(following[around[-1]])
        result.append(around)
    return np.array(result)


def face_begin(result):
    """Where the friction face begins; a lever frame's root has nodes at its height too."""
    if result.parameter("Mesh", "File"):
        return 0.0
    if result.parameter("Friction plate", "Type") == "on sensors":
        return float(result.parameter("Friction plate", "Begin"))
    if result.parameter("Lever", "Outline") == "frame":
        return float(result.parameter("Lever frame", "Root")) + float(result.parameter("Lever frame", "Rib"))
    return 0.0


def built_in_parts(result, corners):
    """Cells by part, told from where they lie; the web of a frame counts as lever."""
    middle = corners.mean(axis=1)
    length = lambda section, name: float(result.parameter(section, name))
    hub = (middle[:, 0] < 0) & (result.parameter("Lever", "Outline") == "bar")
    height = middle[:, 1] - length("Geometry", "Interface offset") - length("Friction layer", "Thickness")
    before = ~hub & (middle[:, 0] > face_begin(result))
    layer = before & (height < 0)
    plate = np.zeros_like(layer)
    if result.parameter("Friction plate", "Type") == "on sensors":
        plate = before & ~layer & (height < length("Friction plate", "Thickness"))
    parts = {"lever": ~hub & ~layer & ~plate, "layer": layer, "plate": plate, "hub": hub}
    return {name: corners[part] for name, part in parts.items() if part.any()}


def of_folder(folder):
    """The mesh of a run, undeformed, and the cylinder at its turning point."""
    result = read_result(folder)
    frame = folder / "fields-0000.h5"
    if not frame.is_file():
        raise NotAResult(f"{folder}: no fields-0000.h5 there; Output/Fields must not be none")
    with h5py.File(frame, "r") as file:
        nodes, cells = file["nodes"][:, :2], file["cells"][:]
    corners = nodes[outlines(cells, int(result.parameter("Mesh", "Degree")) ** 2)]
    mesh = Mesh(folder.resolve().name)
    offset = float(result.parameter("Geometry", "Interface offset"))
    if result.parameter("Mesh", "File"):
        mesh.parts = {"": corners}
    else:
        mesh.parts = built_in_parts(result, corners)
    low = np.abs(nodes[:, 1] - offset) < 1e-6
    along = nodes[low & (nodes[:, 0] >= face_begin(result) - 1e-9), 0]
    mesh.face = np.array([[[along.min(), offset], [along.max(), offset]]])
    turn = np.nanargmax(result.table["x"])
    mesh.centre = result.table["s"][turn]
    radius = float(result.parameter("Geometry", "Cylinder radius"))
    mesh.circle = (mesh.centre - result.table["centre_offset"][turn], offset - radius, radius)
    return mesh


def sections(path):
    """{name: lines} of a .msh file."""
    found, name = {}, None
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("$End"):
            name = None
        elif line.startswith("$"):
            name = line[1:]
            found[name] = []
        elif name:
            found[name].append(line)
    return found


def elements_of_version_2(text):
    nodes = {int(line.split()[0]): [float(word) for word in line.split()[1:3]] for line in text["Nodes"][1:]}
    elements = []
    for line in text["Elements"][1:]:
        numbers = [int(word) for word in line.split()]
        elements.append((numbers[1], numbers[3], numbers[3 + numbers[2] :]))
    return nodes, elements


def elements_of_version_4(text):
    groups = {}  # (dimension, tag of the entity) -> physical group
    lines = iter(text.get("Entities", ["0 0 0 0"]))
    counts = [int(word) for word in next(lines).split()]
    for dimension, count in enumerate(counts):
        for _ in range(count):
            words = next(lines).split()
            box = 4 if dimension == 0 else 7
            if int(words[box]) > 0:
                groups[dimension, int(words[0])] = abs(int(words[box + 1]))
    nodes = {}
    lines = iter(text["Nodes"][1:])
    for header in lines:
        count = int(header.split()[3])
        tags = [int(next(lines)) for _ in range(count)]
        nodes.update({tag: [float(word) for word in next(lines).split()[:2]] for tag in tags})
    elements = []
    lines = iter(text["Elements"][1:])
    for header in lines:
        dimension, entity, kind, count = (int(word) for word in header.split())
        for _ in range(count):
            elements.append((kind, groups.get((dimension, entity), 0), [int(word) for word in next(lines).split()[1:]]))
    return nodes, elements


def of_msh(path):
    """The mesh of a file, coloured by its physical groups."""
    try:
        text = sections(path)
        version, binary = text["MeshFormat"][0].split()[:2]
        if binary != "0" or version not in ("2.2", "4.1"):
            raise NotAResult(f"{path}: must be ASCII of version 2.2 or 4.1")
        nodes, elements = (elements_of_version_2 if version == "2.2" else elements_of_version_4)(text)
        names = {}
        for line in text.get("PhysicalNames", [])[1:]:
            dimension, tag, name = line.split(maxsplit=2)
            names[int(dimension), int(tag)] = name.strip('"')
    except (OSError, KeyError, ValueError, IndexError, StopIteration) as error:
        raise NotAResult(f"{path}: cannot be read as a .msh file ({error})") from error
    mesh = Mesh(path.name)
    parts, face = {}, []
    for kind, group, vertices in elements:
        if kind == 3:
            name = names.get((2, group), "")
            parts.setdefault(name if name in FILLS else "", []).append([nodes[v] for v in vertices[-4:]])
        elif kind == 1 and names.get((1, group)) == "friction face":
            face.append([nodes[v] for v in vertices[-2:]])
    if not parts:
        raise NotAResult(f"{path}: no quadrilaterals in it")
    mesh.parts = {name: np.array(cells) for name, cells in parts.items()}
    mesh.face = np.array(face).reshape(-1, 2, 2)
    every = mesh.face if len(face) else np.concatenate(list(mesh.parts.values()))
    mesh.centre = every[..., 0].min() / 2 + every[..., 0].max() / 2
    return mesh


def draw_parts(axes, mesh, width):
    for name, cells in mesh.parts.items():
        axes.add_collection(PolyCollection(cells, facecolor=FILLS[name], edgecolor="0.25", linewidth=width, label=name or None))
    axes.add_collection(LineCollection(mesh.face, colors="#D55E00", linewidths=1.4, label="friction face"))
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("along the lever [mm]")
    axes.set_ylabel("across [mm]")


def figure_of(mesh):
    figure, (whole, zoom) = plt.subplots(2, 1, figsize=(plot.TWO_COLUMNS, 125 * plot.MILLIMETRE), height_ratios=(1, 0.95))
    vertices = np.concatenate([cells.reshape(-1, 2) for cells in mesh.parts.values()])
    (left, low), (right, high) = vertices.min(axis=0), vertices.max(axis=0)
    draw_parts(whole, mesh, 0.15)
    whole.set_xlim(left - 4, right + 4)
    whole.set_ylim(min(low, 0) - 6, high + 5)
    whole.plot(0, 0, "ko", markersize=4, label="pivot")
    whole.legend(loc="lower right", ncols=5)
    whole.set_title(mesh.name, fontsize=8)

    bottom = mesh.face[..., 1].min() if len(mesh.face) else low
    draw_parts(zoom, mesh, 0.4)
    if mesh.circle:
        x, y, radius = mesh.circle
        zoom.add_patch(plt.Circle((x, y), radius, facecolor="0.93", edgecolor="black", linewidth=0.8, zorder=0))
        zoom.annotate("cylinder", (x, bottom - 0.55), ha="center", va="center")
    zoom.set_xlim(mesh.centre - HALF_WIDTH, mesh.centre + HALF_WIDTH)
    zoom.set_ylim(bottom - 1, bottom + 4)
    return figure


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", nargs="+", type=Path, metavar="DIR|FILE.msh")
    parser.add_argument("--output", type=Path, help="the picture; default mesh.png in the folder, or FILE.png beside the file")
    options = parser.parse_args(arguments)
    if options.output and len(options.meshes) > 1:
        parser.error("--output goes with one mesh only")
    plot.use_print_style()
    try:
        for path in options.meshes:
            mesh = of_folder(path) if path.is_dir() else of_msh(path)
            default = path / "mesh.png" if path.is_dir() else path.with_suffix(".png")
            figure = figure_of(mesh)
            figure.savefig(options.output or default, dpi=DPI)
            plt.close(figure)
    except (NotAResult, OSError) as error:
        print(f"mesh.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
