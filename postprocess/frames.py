"""Reads the frames of displacement and stress that sprag writes beside result.h5, and where the apparatus stood in each."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
import re

import h5py
import numpy as np

from results import NotAResult

# As FieldFrames writes them.
PARTS = {1: "lever", 2: "layer", 3: "hub", 4: "web", 5: "plate", 6: "cylinder", 7: "leaf"}
WAYS = {"forward": 1, "backward": -1}


@dataclass
class Frame:
    """One written frame: quadrilaterals, p x p of them in a cell of degree p, whose nodes no other cell shares."""

    nodes: np.ndarray  # [n x 2]
    quads: np.ndarray  # [m x 4] node numbers
    displacement: np.ndarray  # [n x 2]
    stress: np.ndarray  # von Mises [n]
    part: np.ndarray  # names [n]
    degree: int

    @cached_property
    def outlines(self):
        """Node numbers around each cell [cells x 4 p]."""
        side = np.arange(self.degree + 1)
        grid = np.arange((self.degree + 1) ** 2).reshape(self.degree + 1, -1)
        around = np.concatenate((grid[0], grid[1:, -1], grid[-1, -2::-1], grid[-2:0:-1, 0]))
        first = np.arange(0, len(self.nodes), len(side) ** 2)
        return first[:, None] + around

    @cached_property
    def cell_part(self):
        return self.part[self.outlines[:, 0]]

    def shown(self, names):
        """Which nodes belong to those parts."""
        return np.isin(self.part, names)

    def borders(self, names=tuple(PARTS.values())):
        """Node numbers of the edges between parts and on the outside of those named [edges x 2]."""
        cells = self.outlines[np.isin(self.cell_part, names)]
        edges = np.stack((cells, np.roll(cells, -1, axis=1)), axis=-1).reshape(-1, 2)
        if len(edges) == 0:
            return edges
        places = np.unique(np.round(self.nodes, 6) + 0.0, axis=0, return_inverse=True)[1].reshape(-1)
        keys = np.column_stack((np.sort(places[edges], axis=1), np.unique(self.part, return_inverse=True)[1][edges[:, 0]]))
        _, index, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
        return edges[index[counts == 1]]


def read_frame(path):
    try:
        with h5py.File(path, "r") as file:
            numbers = file["part"][:].ravel().round().astype(int)
            quads = file["cells"][:].astype(int)
            frame = Frame(
                nodes=file["nodes"][:, :2],
                quads=quads,
                displacement=file["displacement"][:, :2],
                stress=file["von_mises_stress"][:].ravel(),
                part=np.array([PARTS.get(number, "") for number in range(numbers.max() + 1)])[numbers],
                degree=0,
            )
    except (OSError, KeyError) as error:
        raise NotAResult(f"{path}: cannot be read as a frame of this version of sprag ({error})") from error
    # m = p^2 cells and n = (p + 1)^2 cells.
    frame.degree = round(1 / (np.sqrt(len(frame.nodes) / len(quads)) - 1))
    return frame


def indexed(folder, name="fields"):
    """[(time, file)] of the frames written so far, in order."""
    index = Path(folder) / f"{name}.xdmf"
    if not index.is_file():
        return []
    found = re.findall(r'<Time Value="([^"]+)".*?(\S+\.h5):/nodes', index.read_text(encoding="utf-8"), re.DOTALL)
    return [(float(time), index.parent / file) for time, file in found]


@dataclass
class Pose:
    """Where the apparatus stands: x along the cylinder's path towards the pivot, y up."""

    x: float  # of the cylinder's centre, which has y = 0
    pivot: np.ndarray
    theta: float  # of the lever at its hub

    def centre(self):
        """Of the cylinder, in lever axes."""
        away = np.array((self.x, 0.0)) - self.pivot
        return np.array((-np.cos(self.theta) * away[0] + np.sin(self.theta) * away[1],
                         np.sin(self.theta) * away[0] + np.cos(self.theta) * away[1]))  # fmt: skip

    def place(self, points, theta=None):
        """From axes at the pivot, inclined by theta (the lever's unless given), [n x 2]."""
        angle = self.theta if theta is None else theta
        along, across = np.array((-np.cos(angle), np.sin(angle))), np.array((np.sin(angle), np.cos(angle)))
        return self.pivot + points[..., :1] * along + points[..., 1:] * across


def pose(result, row):
    """Of one row of the table."""
    table = result.table
    moved = table["support_displacement"][row] if result.has("support_displacement") else 0.0
    pivot = np.array((number(result, "Geometry", "Pivot distance") + moved, number(result, "Geometry", "Pivot height")))
    return Pose(table["x"][row], pivot, table["theta"][row])


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


def has_leaf(result):
    """Whether frames of a leaf spring in the folder are of this run, not of one before it."""
    try:
        return result.parameter("Rotational spring", "Type") == "leaf"
    except KeyError:
        return False


@dataclass
class Written:
    """A frame that is there to be chosen."""

    file: Path
    time: float  # as the index gives it, to six places
    row: int  # of the table
    x: float
    way: int  # 1 forward, -1 backward; a turning point belongs to the stroke that led to it


def written_frames(result):
    """Of a run in which the cylinder moves."""
    if "modes" in result.groups:
        raise NotAResult(f"{result.folder}: its frames are modes, which plot.py draws along the face and ParaView as fields.xdmf")
    if result.is_sweep or len(result.table["time"]) == 0:
        return []
    x, times = result.table["x"], result.table["time"]
    steps = np.diff(x, prepend=x[0])
    moving = np.flatnonzero(steps)
    last = np.maximum(np.searchsorted(moving, np.arange(len(x)), side="right") - 1, 0)
    ways = np.sign(steps[moving[last]]).astype(int) if len(moving) else np.ones(len(x), dtype=int)
    found = [(file, time, int(np.abs(times - time).argmin())) for time, file in indexed(result.folder) if file.is_file()]
    return [Written(file, time, row, x[row], ways[row]) for file, time, row in found]


def chosen_frame(result, x=None, way=None):
    """The frame nearest to x, that of the largest x where none is asked for. Throws NotAResult where there is none near."""
    frames = written_frames(result)
    candidates = [frame for frame in frames if way is None or frame.way == WAYS[way]]
    if not frames:
        raise NotAResult(f"{result.folder}: no frames of fields there; Output/Fields must not be none, and Analysis/Model be meshed")
    near = number(result, "Output", "Field interval") / 2
    if x is None and candidates:
        return max(candidates, key=lambda frame: frame.x)
    nearest = min(candidates, key=lambda frame: abs(frame.x - x), default=None)
    if nearest is None or abs(nearest.x - x) > near:
        wanted = " ".join(filter(None, (f"at x = {x:g} mm" if x is not None else "", way)))
        raise NotAResult(f"{result.folder}: no frame {wanted}: there are {listed(frames)}; {how_to_get_more(result)}")
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
