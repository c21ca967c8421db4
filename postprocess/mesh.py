#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws meshes, each part in a colour: of a result folder of sprag (with fields), or of an ASCII .msh file of version 2.2 or 4.1."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from arguments import add_output, make_parser, picture_paths, save, script
from frames import number, pose, read_frame
from sprag.results import NotAResult, read_result
from style import MILLIMETRE, TWO_COLUMNS, legend_on_top, plt, use_print_style

FILLS = {
    "lever": "#cfe2f3",
    "layer": "#e8c28c",
    "hub": "#bfbfbf",
    "web": "#e7d4e8",
    "plate": "#b8e0c8",
    "cylinder": "#f6e8a6",
    "leaf": "#f4c7b8",
    "": "white",
}
CURVES = {
    "friction face": "#D55E00",
    "hub": "black",
    "core": "#7f3b08",
    "cylinder face": "#CC79A7",
    "sensor plate": "#0072B2",
    "sensor lever": "#009E73",
    "joint": "#E69F00",
}
HALF_WIDTH, HALF_HEIGHT = 6.0, 2.5  # mm shown in the zoom to each side
DPI = 150


class Mesh:
    """Polygons by part, named curves, and where to look closely."""

    def __init__(self, name):
        self.name = name
        self.parts = {}  # a name of FILLS -> [cells x vertices x 2]
        self.curves = {}  # a name of CURVES -> segments [n x 2 x 2]
        self.look = None  # middle of what is seen closely
        self.circle = None  # centre x, centre y, radius of a rigid cylinder

    def every_point(self):
        return np.concatenate([cells.reshape(-1, 2) for cells in self.parts.values()])


def read_folder(folder):
    """The mesh of a run, undeformed, with the cylinder at its turning point and the leaf spring as it was made."""
    result = read_result(folder)
    if not (folder / "fields-mesh.h5").is_file():
        raise NotAResult(f"{folder}: no fields-mesh.h5 there; Output/Fields must not be none")
    mesh = Mesh(folder.resolve().name)
    frame, leaf = read_frame(result)
    stands = pose(result, int(np.nanargmax(result.table["x"])) if "x" in result.table else 0)
    centre = stands.centre()
    nodes = np.where(frame.shown(["cylinder"])[:, None], frame.nodes + centre, frame.nodes)
    add_parts(mesh, frame, nodes)
    if leaf is not None:
        add_parts(mesh, leaf, leaf.nodes)
    outermost = next(name for name in ("layer", "plate", "lever") if name in mesh.parts)
    edges = nodes[frame.borders([outermost])]
    offset = number(result, "Geometry", "Interface offset")
    mesh.curves["friction face"] = edges[(np.abs(edges[..., 1] - offset) < 1e-4).all(axis=1)]
    if "cylinder" not in mesh.parts:
        mesh.circle = (*centre, number(result, "Geometry", "Cylinder radius"))
    mesh.look = (centre[0], offset + 1.5)
    return mesh


def add_parts(mesh, frame, nodes):
    for name in dict.fromkeys(frame.cell_part):
        mesh.parts[name if name in FILLS else ""] = nodes[frame.outlines[frame.cell_part == name]]


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


def read_elements_2(text):
    nodes = {int(line.split()[0]): [float(word) for word in line.split()[1:3]] for line in text["Nodes"][1:]}
    elements = []
    for line in text["Elements"][1:]:
        numbers = [int(word) for word in line.split()]
        elements.append((numbers[1], numbers[3], numbers[3 + numbers[2] :]))
    return nodes, elements


def read_elements_4(text):
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


def read_msh(path):
    """The mesh of a file, coloured by its physical groups."""
    try:
        text = sections(path)
        version, binary = text["MeshFormat"][0].split()[:2]
        if binary != "0" or version not in ("2.2", "4.1"):
            raise NotAResult(f"{path}: must be ASCII of version 2.2 or 4.1")
        nodes, elements = (read_elements_2 if version == "2.2" else read_elements_4)(text)
        names = {}
        for line in text.get("PhysicalNames", [])[1:]:
            dimension, tag, name = line.split(maxsplit=2)
            names[int(dimension), int(tag)] = name.strip('"')
    except (OSError, KeyError, ValueError, IndexError, StopIteration) as error:
        raise NotAResult(f"{path}: cannot be read as a .msh file ({error})") from error
    mesh = Mesh(path.name)
    parts, curves = {}, {}
    for kind, group, vertices in elements:
        if kind == 3:
            name = names.get((2, group), "")
            parts.setdefault(name if name in FILLS else "", []).append([nodes[v] for v in vertices[-4:]])
        elif kind == 1 and names.get((1, group)) in CURVES:
            curves.setdefault(names[1, group], []).append([nodes[v] for v in vertices[-2:]])
    if not parts:
        raise NotAResult(f"{path}: no quadrilaterals in it")
    mesh.parts = {name: np.array(cells) for name, cells in parts.items()}
    mesh.curves = {name: np.array(segments) for name, segments in curves.items()}
    mesh.look = choose_look(mesh)
    return mesh


def choose_look(mesh):
    """The contact where there is one to be; a leaf spring's joint."""
    for name, up in (("friction face", 1.5), ("cylinder face", -1.5), ("joint", 0)):
        if name in mesh.curves:
            points = mesh.curves[name].reshape(-1, 2)
            return (points.min(axis=0) + points.max(axis=0)) / 2 + (0, up)
    return mesh.every_point().mean(axis=0)


def draw_parts(axes, mesh, width):
    for name, cells in mesh.parts.items():
        axes.add_collection(PolyCollection(cells, facecolor=FILLS[name], edgecolor="0.25", linewidth=width, label=name or None))
    for name, segments in mesh.curves.items():
        axes.add_collection(LineCollection(segments, colors=CURVES[name], linewidths=1.4, label=curve_label(mesh, name), zorder=3))
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("along the lever [mm]")
    axes.set_ylabel("across [mm]")


def curve_label(mesh, curve):
    """A curve may bear the name of a part."""
    return f"{curve} (curve)" if curve in mesh.parts else curve


def draw_mesh(mesh):
    (left, low), (right, high) = mesh.every_point().min(axis=0), mesh.every_point().max(axis=0)
    low = min(low, 0)
    height = np.clip((high - low + 11) / (right - left + 8), 0.25, 0.8) * 152
    figure, (whole, zoom) = plt.subplots(
        2, 1, figsize=(TWO_COLUMNS, (height + 90) * MILLIMETRE), height_ratios=(height, 65)
    )
    draw_parts(whole, mesh, 0.15)
    whole.set_xlim(left - 4, right + 4)
    whole.set_ylim(low - 6, high + 5)
    if set(mesh.parts) != {"cylinder"}:
        whole.plot(0, 0, "ko", markersize=4, label="pivot", zorder=4)
    handles, names = whole.get_legend_handles_labels()
    legend_on_top(figure, handles, names)
    whole.set_title(mesh.name, fontsize=8)

    draw_parts(zoom, mesh, 0.4)
    if mesh.circle:
        x, y, radius = mesh.circle
        zoom.add_patch(plt.Circle((x, y), radius, facecolor="0.93", edgecolor="black", linewidth=0.8, zorder=0))
        zoom.annotate("cylinder", (x, y + radius - 0.55), ha="center", va="center")
    zoom.set_xlim(mesh.look[0] - HALF_WIDTH, mesh.look[0] + HALF_WIDTH)
    zoom.set_ylim(mesh.look[1] - HALF_HEIGHT, mesh.look[1] + HALF_HEIGHT)
    return figure


@script
def main(arguments=None):
    parser = make_parser(__doc__)
    parser.add_argument("meshes", nargs="+", type=Path, metavar="DIR|FILE.msh")
    add_output(parser, default="mesh.png in the folder, or FILE.png beside the file")
    options = parser.parse_args(arguments)
    if options.output and len(options.meshes) > 1:
        parser.error("-o goes with one mesh only")
    use_print_style()
    for path in options.meshes:
        mesh = read_folder(path) if path.is_dir() else read_msh(path)
        figure = draw_mesh(mesh)
        save(figure, picture_paths(options, path / "mesh" if path.is_dir() else path.with_suffix("")), DPI)
        plt.close(figure)


if __name__ == "__main__":
    sys.exit(main())
