#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Model A in three dimensions, forward stroke, by CalculiX and by sprag on the same bricks: P, Q, theta, largest pressure and CPU
time side by side. See peers.md. Not part of the tests: whoever runs it installs CalculiX (Debian: calculix-ccx).

    tests/benchmarks/peer_solid.py --face-size 2 --across 4"""

import argparse
import math
import os
import re
import resource
import subprocess
import tempfile
from pathlib import Path

import h5py
import numpy as np
from runs import add_program, print_row, run_scene

R, E_OFFSET, PIVOT, SPRING = 56.0, 45.6, 185.5, 7.4e4
LENGTH, DEPTH, WIDTH, THICKNESS = 210.0, 20.0, 40.0, 1.0
METAL, LAYER = (70000.0, 0.33), (20.0, 0.2)
FRICTION, STROKE = 0.73, 65.0
GROWTH_ACROSS = 1.2
SHORT = 0.02  # length of the last two increments before a place of the table [mm]


def inclination(x):
    return math.asin((R - E_OFFSET) / (PIVOT - x))


def contact_place(x):
    return (PIVOT - x) * math.cos(inclination(x))


def growing(size, length, growth=1.2, largest=3.0):
    """Lengths from `size` that grow up to `largest` and fill `length`."""
    result = []
    while sum(result) < length - 1e-9:
        size = min(size * growth, max(largest, size))
        result.append(size)
    return [part * length / sum(result) for part in result]


def planes(face_size, across):
    """Planes between the elements along the lever, through it and over half its width, as meshes/lever.geo and sprag lay them."""
    room = 0.1 * R
    first, last = contact_place(STROKE) - room, contact_place(0.0) + room
    fine = math.ceil((last - first) / face_size - 1e-6)
    along = growing(face_size, first)[::-1] + [(last - first) / fine] * fine + growing(face_size, LENGTH - last)
    rows = max(2, math.ceil(THICKNESS / face_size - 1e-6))
    first_row, ratio = max(2 * face_size, THICKNESS), 1.5
    metal = max(2, math.ceil(math.log(1 + DEPTH * (ratio - 1) / first_row) / math.log(ratio)))
    deep = [ratio**i for i in range(metal)]
    deep = [THICKNESS / rows] * rows + [DEPTH * part / sum(deep) for part in deep]
    half = [GROWTH_ACROSS ** min(i, across - 1 - i) for i in range(across)]
    half = [part * WIDTH / sum(half) for part in half][across // 2:]
    start = lambda begin, parts: begin + np.concatenate(([0.0], np.cumsum(parts)))
    return start(0.0, along), start(E_OFFSET, deep), start(0.0, half), rows


class Bricks:
    """A block of bricks with 20 nodes; its axes a, b, c are right-handed."""

    CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
    MIDDLES = ((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
               (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1))

    def __init__(self, axes, first_node, first_element):
        middles = [np.sort(np.concatenate((axis, 0.5 * (axis[1:] + axis[:-1])))) for axis in axes]
        self.counts = [len(axis) - 1 for axis in axes]
        self.places, self.number = {}, {}
        for i, a in enumerate(middles[0]):
            for j, b in enumerate(middles[1]):
                for k, c in enumerate(middles[2]):
                    if i % 2 + j % 2 + k % 2 < 2:
                        self.number[i, j, k] = first_node + len(self.number)
                        self.places[i, j, k] = (a, b, c)
        self.first_element = first_element
        self.n_elements = self.counts[0] * self.counts[1] * self.counts[2]

    def element(self, i, j, k):
        return self.first_element + (i * self.counts[1] + j) * self.counts[2] + k

    def elements(self):
        for i in range(self.counts[0]):
            for j in range(self.counts[1]):
                for k in range(self.counts[2]):
                    at = [(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in self.CORNERS + self.MIDDLES]
                    yield (i, j, k), [self.element(i, j, k), *(self.number[place] for place in at)]

    def nodes(self, chosen=lambda place: True):
        return [self.number[place] for place in self.number if chosen(place)]


def numbers(values):
    """Lines of at most twelve of them, as CalculiX reads them."""
    values = list(map(str, values))
    return [", ".join(values[i:i + 12]) + ("," if i + 12 < len(values) else "") for i in range(0, len(values), 12)]


class Deck:
    """The scene's half for CalculiX. The lever lies at the inclination of where the slide begins; the cylinder is an arc of bricks,
    all of whose nodes are moved."""

    def __init__(self, settings, start, places):
        self.settings, self.start, self.stops = settings, start, places
        self.spring = settings.spring * SPRING / 2
        along, deep, across, self.rows = planes(settings.face_size, settings.across)
        self.lever = Bricks((along, across, deep), 1, 1)
        edge, most = 4.0 / R, inclination(STROKE)
        angles = np.linspace(inclination(0.0) - edge, most + edge, 2 + int((most - inclination(0.0) + 2 * edge) * R / settings.arc))
        beyond = np.concatenate(([-1.0], across[1:-1], [across[-1] + 1.0]))
        self.cylinder = Bricks((angles, np.array([R - 2.0, R]), beyond), 1 + len(self.lever.number), 1 + self.lever.n_elements)
        self.pivot = 1 + len(self.lever.number) + len(self.cylinder.number)
        self.turn = self.pivot + 1

    def in_world(self, xi, zeta, eta):
        angle = inclination(self.start)
        return (PIVOT - xi * math.cos(angle) + eta * math.sin(angle), xi * math.sin(angle) + eta * math.cos(angle), zeta)

    @property
    def displacements(self):
        return 3 * len(self.lever.number)

    def mesh(self):
        lines = ["*NODE, NSET=Nall"]
        for place, number in self.lever.number.items():
            lines.append(f"{number}, " + ", ".join(f"{value:.12g}" for value in self.in_world(*self.lever.places[place])))
        for place, number in self.cylinder.number.items():
            angle, radius, zeta = self.cylinder.places[place]
            lines.append(f"{number}, {self.start + radius * math.sin(angle):.12g}, {radius * math.cos(angle):.12g}, {zeta:.12g}")
        lines += [f"{self.pivot}, {PIVOT}, 0, 0", f"{self.turn}, {PIVOT}, 0, 0"]
        element_sets = {"layer": [], "metal": []}
        for (_, _, k), element in self.lever.elements():
            element_sets["layer" if k < self.rows else "metal"].append(element)
        element_sets["cylinder"] = [element for _, element in self.cylinder.elements()]
        for name, elements in element_sets.items():
            lines.append(f"*ELEMENT, TYPE=C3D20, ELSET={name}")
            for element in elements:
                lines += numbers(element)
        last = self.lever.n_elements + self.cylinder.n_elements
        return lines + ["*ELEMENT, TYPE=SPRING1, ELSET=spring", f"{last + 1}, {self.turn}"]

    def sets(self):
        sets = {"hub": self.lever.nodes(lambda place: place[0] == 0),
                "middle": self.lever.nodes(lambda place: place[1] == 0 and place[0] > 0),
                "moved": self.cylinder.nodes()}
        lines = []
        for name, nodes in sets.items():
            lines += [f"*NSET, NSET={name}", *numbers(nodes)]
        counts = self.lever.counts
        face = [f"{self.lever.element(i, j, 0)}, S1" for i in range(counts[0]) for j in range(counts[1])
                if self.lever.places[2 * i + 2, 0, 0][0] > contact_place(STROKE) - 0.1 * R]
        counts = self.cylinder.counts
        arc = [f"{self.cylinder.element(i, 0, k)}, S5" for i in range(counts[0]) for k in range(counts[2])]
        return lines + ["*SURFACE, NAME=face, TYPE=ELEMENT", *face, "*SURFACE, NAME=arc, TYPE=ELEMENT", *arc]

    def properties(self):
        spring, penalty = self.spring, self.settings.penalty
        lines = []
        for name, (modulus, ratio) in (("layer", LAYER), ("metal", METAL), ("cylinder", METAL)):
            lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{modulus}, {ratio}"]
            lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL={name}"]
        return lines + [
            "*SPRING, ELSET=spring", "3", f"{spring}",
            f"*RIGID BODY, NSET=hub, REF NODE={self.pivot}, ROT NODE={self.turn}",
            "*BOUNDARY", "middle, 3, 3", f"{self.pivot}, 1, 3", f"{self.turn}, 1, 2",
            "*SURFACE INTERACTION, NAME=rubbing", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{penalty}",
            "*FRICTION", f"{FRICTION}, {penalty}",
            "*CONTACT PAIR, INTERACTION=rubbing, TYPE=SURFACE TO SURFACE", "face, arc"]

    def steps(self):
        """The slide in increments of --step, and before each place of the table ones so short that what CalculiX leaves out hardly
        shows: within an increment it measures gaps along the normals where the increment began, off by its length^2 / 2R."""
        lines, x = [], self.start
        if x > 0.0:
            preload = self.spring * (inclination(x) - inclination(0.0))
            lines += self.one_step(1.0, 0.5, 0.0, ["*CLOAD", f"{self.turn}, 3, {preload:.12g}"])
        for place in self.stops:
            parts = [(place - x - SHORT, self.settings.step), (SHORT, SHORT / 2)]
            for length, increment in parts:
                x += length
                lines += self.one_step(length, length / math.ceil(length / increment - 1e-9), x - self.start, [])
            lines[-1:-1] = ["*NODE PRINT, NSET=moved, TOTALS=ONLY, FREQUENCY=1000", "RF",
                            "*NODE PRINT, NSET=turned, FREQUENCY=1000", "U", "*CONTACT PRINT, FREQUENCY=1000", "CSTR"]
        return lines

    @staticmethod
    def one_step(length, increment, end, loads):
        return ["*STEP, NLGEOM, INC=1000", "*STATIC", f"{increment:.9g}, {length:.9g}, {1e-4 * length:.9g}, {increment:.9g}",
                "*BOUNDARY", f"moved, 1, 1, {end:.9g}", "moved, 2, 3, 0", *loads, "*END STEP"]

    def text(self):
        extra = ["*NSET, NSET=turned", str(self.turn)]
        return "\n".join(self.mesh() + self.sets() + extra + self.properties() + self.steps()) + "\n"


def cpu_seconds(run):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = run()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return result, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def calculix(settings, deck, folder):
    """P, Q, theta and the largest pressure of the contact points at the deck's places; RuntimeError where it does not get there."""
    (folder / "deck.inp").write_text(deck.text())
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run([settings.ccx, "-i", "deck"], cwd=folder, env=environment, capture_output=True, text=True, check=False)
    blocks = re.split(r"\n (?=total force|displacements|contact stress)", (folder / "deck.dat").read_text())
    values = lambda block: [list(map(float, line.split())) for line in block.split("\n")[2:] if line.strip()]
    forces, turns, stresses = ([values(block) for block in blocks if block.lstrip().startswith(word)]
                               for word in ("total force", "displacements", "contact stress"))
    if len(stresses) < len(deck.stops):
        raise RuntimeError(f"{settings.ccx}: {(done.stdout + done.stderr).strip()[-400:]}")
    result = []
    for ((along, upward, _),), ((*_, turn),), points in zip(forces, turns, stresses):
        theta = inclination(deck.start) - turn
        P = 2.0 * (along * math.sin(theta) + upward * math.cos(theta))
        result.append((P, 2.0 * along, theta, max(point[2] for point in points)))
    increments = [line.split() for line in (folder / "deck.sta").read_text().splitlines()[2:]]
    return result, len(increments), sum(int(words[3]) for words in increments)


def calculix_at_places(settings, folder):
    """One slide from 0, or one of --slide before each place. What is found of all, displacements, increments and iterations."""
    if settings.slide == 0:
        decks = [Deck(settings, 0.0, settings.places)]
    else:
        decks = [Deck(settings, max(0.0, place - settings.slide), [place]) for place in settings.places]
    found = [calculix(settings, deck, folder) for deck in decks]
    return sum((rows for rows, *_ in found), []), decks[0].displacements, sum(n for _, n, _ in found), sum(n for *_, n in found)


def sprag(settings, folder):
    changes = {
        "Friction/Law": "Coulomb", "Friction/Coefficient": FRICTION, "Drive/Cycles": 0.5, "Mesh/Face size": settings.face_size,
        "Mesh/Elements across": settings.across, "Contact/Penalty": settings.penalty,
        "Rotational spring/Stiffness": settings.spring * SPRING,
    }
    run_scene(settings.sprag, "solid-a.prm", changes, folder / "sprag")
    with h5py.File(folder / "sprag" / "result.h5", "r") as file:
        table = {name: file["table"][name][:] for name in ("x", "P", "Q", "theta", "penetration", "largest_pressure")}
        table["penetration"] *= settings.penalty  # the largest pressure of the points
        displacements = int(file["meta/degrees_of_freedom"][()])
    at = lambda place: [float(np.interp(place, table["x"], table[name])) for name in list(table)[1:]]
    return [at(place) for place in settings.places], displacements, len(table["x"]) - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_program(parser)
    parser.add_argument("--ccx", default="ccx", help="the program; default ccx")
    parser.add_argument("--face-size", type=float, default=2.0)
    parser.add_argument("--across", type=int, default=4, help="elements over the whole width, of which half are solved")
    parser.add_argument("--arc", type=float, default=0.5, help="length of the cylinder's faces for CalculiX [mm]")
    parser.add_argument("--penalty", type=float, default=240.0, help="normal and tangential [N/mm3]")
    parser.add_argument("--spring", type=float, default=1.0, help="rotational spring over model A's")
    parser.add_argument("--slide", type=float, default=0.4, help="CalculiX' way before each place [mm]; 0: from x = 0 in one run")
    parser.add_argument("--step", type=float, default=0.2, help="increment of CalculiX [mm]")
    parser.add_argument("--places", type=float, nargs="+", default=[13.0, 26.0, 39.0, 52.0, 65.0], help="x of the table [mm]")
    settings = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (theirs, displacements, increments, iterations), cpu_theirs = cpu_seconds(lambda: calculix_at_places(settings, folder))
        (ours, unknowns, steps), cpu_ours = cpu_seconds(lambda: sprag(settings, folder))
    print(f"CalculiX: {displacements} displacements (C3D20), {increments} increments, {iterations} iterations, "
          f"{cpu_theirs:.1f} CPU s")
    print(f"sprag:    {unknowns} displacements, {steps} steps, {cpu_ours:.1f} CPU s")
    widths = (6, 13, 11, 8) + (11, 11, 8) * 3 + (11,)
    heads = ["x mm", "P: CalculiX", "sprag N", "%", "Q", "N", "%", "theta", "rad", "%", "p", "MPa", "%", "recovered"]
    print_row(heads, widths)
    for place, theirs_there, ours_there in zip(settings.places, theirs, ours):
        cells = [f"{place:g}"]
        for b, a in zip(theirs_there, ours_there):
            cells += [f"{b:.6g}", f"{a:.6g}", f"{100.0 * (a / b - 1.0):.3f}"]
        print_row(cells + [f"{ours_there[-1]:.6g}"], widths)


if __name__ == "__main__":
    main()
