# SPDX-License-Identifier: GPL-3.0-only
"""The rows of tests/robustness/extremes.py."""

import math
from dataclasses import dataclass, field

from extreme_runs import (
    closes,
    deviation,
    peak_deviation,
    equal_rows,
    forces,
    loop_area,
    numbers,
    peaks,
    pressure,
    quasi_static_in_time,
)


COARSE = ("Mesh/Face size=0.5", "Analysis/Step=2")  # cheap, and no other than the defaults in what is looked at


@dataclass
class Row:
    name: str
    scene: str
    options: tuple
    check: object = None  # gives error and what is told of it
    against: str = ""
    limit: float = None  # instead of what is told
    status: int = 0
    says: tuple = ()
    warns: tuple = ()
    forbids: tuple = ()  # warnings that were false alarms
    slow: bool = False
    timeout: int = 120
    base: tuple = field(default=())  # options of run and reference

    def __post_init__(self):
        if self.scene in ("model-a", "model-b", "coulomb-a", "leaf-a"):
            self.base = (*COARSE, *self.base)
        self.options = (*self.base, *self.options)

    def find_scene(self, options, scene=None):
        return scene or self.scene

    def find_options(self, options, scene=None):
        return (*self.base, *options)


def refused(name, scene, options, *says, status=2, **others):
    return Row(name, scene, options, status=status, says=says, **others)


def mu(value):
    return ("Friction/Law=Coulomb", f"Friction/Coefficient={value!r}")


@dataclass
class Device:
    """The rigid lever with its pivot on the path: eqs. 4 to 9."""

    R: float = 56.0
    e: float = 45.6
    l: float = 185.5
    k: float = 7.4e4

    def peaks(self, x, mu):
        D, a = self.l - x, self.R - self.e
        s = math.sqrt(D * D - a * a)
        theta, rest = math.asin(a / D), math.asin(a / self.l)
        result = {}
        for way, sign in (("forward", 1.0), ("backward", -1.0)):
            P = self.k * (theta - rest) / (s + sign * mu * self.e)
            result[f"peak_P_{way}"] = P
            result[f"peak_Q_{way}"] = P * (math.sin(theta) + sign * mu * math.cos(theta))
        return result

    def pivot(self):
        return self.l - self.R

    def locking(self, mu):
        return self.l - math.hypot(mu * self.e, self.R - self.e)


A, B = Device(), Device(21.1, 0.0, 193.9, 6.41e4)
GEOMETRY_B = ("Geometry/Cylinder radius=21.1", "Geometry/Interface offset=0", "Geometry/Pivot distance=193.9")
GEOMETRY_B += ("Rotational spring/Stiffness=6.41e4",)
FINE = ("Mesh/Face size=0.25",)
HARD = (*FINE, "Contact/Penalty=auto")
SHORT = ("Drive/Start=55", "Drive/Stroke=57")


def friction_rows():
    fine = "half the face size"
    for value in (0.0, 1e-6, 1.2, 2.0):
        yield Row(f"mu {value:g}", "model-a", (), forces(FINE), fine, base=mu(value), slow=value == 2)
    yield Row("mu 0, peaks", "model-a", (), peak_deviation, "closed form", 0.02, forbids=("long_steps",), base=mu(0.0))
    for value in (2.5, 2.63):
        yield Row(f"mu {value}, a rigid lever locks at 2.633", "model-a", (), forces(FINE), fine, warns=("near_locking",), base=mu(value))
    says = ("the lever locks", "s = ", "<= mu e = ", "Try a smaller friction coefficient")
    yield refused("mu 3", "model-a", mu(3.0), *says, status=1, warns=("locks",))
    yield Row("mu 1.2, model B", "model-b", (), forces(FINE), fine, base=mu(1.2), slow=True)
    check = numbers(A.peaks(65.0, 2.63))
    yield Row("mu 2.63, rigid lever", "closed-form-a", mu(2.63), check, "eqs. 4 to 9", 1e-9, warns=("near_locking",))
    yield refused("mu 2.64, rigid lever", "closed-form-a", mu(2.64), "Drive/Stroke", "must not lock", "with mu = 2.64")


def penalty_rows():
    hard = "hard contact, half the face size"
    automatic = 1001.86
    soft, stiff = ("soft_penalty",), ("stiff_penalty",)
    for factor, warns in ((1e-3, ("overlap_of_layer", *soft)), (1e-2, soft), (0.1, ()), (10.0, stiff), (20.0, stiff)):
        options = (f"Contact/Penalty={factor * automatic:g}",)
        limit = {1e-3: 0.1, 1e-2: 0.01, 0.1: 1e-3}.get(factor)
        yield Row(f"penalty {factor:g} times", "model-a", options, forces(HARD), hard, limit, warns=warns, slow=factor == 20)
    for factor in (100.0, 1e5):
        says = ("Contact/Penalty", "must be <= 24000 N/mm3")
        yield refused(f"penalty {factor:g} times", "model-a", (f"Contact/Penalty={factor * automatic:g}",), *says)
    for factor in (3.0, 10.0, 20.0):
        options = ("Mesh/Face size=0.25", f"Contact/Penalty={factor * automatic:g}")
        check = pressure(("Mesh/Face size=0.125", "Contact/Penalty=auto"), beyond=20.0)
        yield Row(f"penalty {factor:g} times, pressure from x = 20 mm on", "model-a", options, check, hard, 0.05, slow=True)
    for factor in (1e-3, 0.1, 100.0):
        options = (f"Contact/Tangential penalty={factor * automatic:g}",)
        limit = 0.02 if factor < 0.01 else None
        yield Row(f"tangential penalty {factor:g} times", "model-a", options, forces(HARD), hard, limit)
    says = ("Contact/Tangential penalty", "must be <= ")
    yield refused("tangential penalty 1e5 times", "model-a", ("Contact/Tangential penalty=1e8",), *says)
    augmented = ("Contact/Enforcement=augmented Lagrangian",)
    says = ("augmentation does not converge", "Contact/Maximum augmentations", "Try a larger Contact/Penalty")
    yield refused("penalty 1e-3 times, augmented", "model-a", (*augmented, "Contact/Penalty=1"), *says, status=1)
    yield Row("penalty 10 times, augmented", "model-a", (*augmented, "Contact/Penalty=1e4"), forces(HARD), hard)
    rough = ("Mesh/Degree=1", "Contact/Penalty=1e4")
    yield Row("penalty 10 times, degree 1", "model-a", rough, forces(HARD), hard, warns=("coarse_contact", "stiff_penalty"))


def step_rows():
    fine = "steps of 0.5 mm"
    reference = forces(("Analysis/Step=0.5",))
    loop = loop_area(("Analysis/Step=0.5",))
    check = forces(("Analysis/Step=0.05",))
    yield Row("steps of 0.01 mm", "model-a", ("Analysis/Step=0.01",), check, "steps of 0.05 mm", base=SHORT)
    yield Row("steps of 100 mm", "model-a", ("Analysis/Step=100",), reference, fine)
    yield Row("steps of 100 mm, loop area", "model-a", ("Analysis/Step=100",), loop, fine, warns=("long_steps",))


def part_rows():
    fine = "half the face size"
    for thickness, warns in ((0.01, ("pressure_beyond_strength",)), (10.0, ())):
        base = (f"Friction layer/Thickness={thickness}", "Mesh/Face size=0.25")
        check = forces(("Mesh/Face size=0.125",))
        yield Row(f"layer {thickness:g} mm", "model-a", (), check, fine, warns=warns, base=base, slow=True)
    yield Row("E ratio 1", "model-a", ("Friction layer/Young's modulus=7e4",), deviation, "closed form", 0.005, warns=("coarse_contact",))
    for ratio in (1e6, 1e7):
        says = ("no equilibrium beyond x", "MPa, half of Young's modulus there (Friction layer or Lever/Young's modulus)")
        options = (f"Friction layer/Young's modulus={7e4 / ratio!r}",)
        yield refused(f"E ratio {ratio:g}", "model-a", options, *says, status=1, slow=ratio < 1e7)
    soft = ("Lever/Young's modulus=2e8",)
    yield Row("E ratio 1e7, lever", "model-a", (), forces(FINE), fine, base=soft)
    spring = ("Friction layer/Young's modulus=0.007", "Rotational spring/Stiffness=7.4")
    yield Row("E ratio 1e7, soft spring", "model-a", (), forces(FINE), fine, base=(*spring, *mu(0.73)), slow=True)
    strain = ("Analysis/Plane=strain", "Friction layer/Poisson's ratio=0.4999")
    yield Row("nu 0.4999", "model-a", (), forces(FINE), fine, base=strain)
    leaf = ("Leaf spring/Thickness=0.05", *mu(0.73))
    k = 4.0 * 206000.0 * 40.0 * 0.05**3 / 12.0 / 100.0
    yield Row("leaf 0.05 mm", "leaf-a", leaf, numbers(Device(k=k).peaks(65.0, 0.73)), "eqs. 4 to 9, k = 4 EI/L", 2e-3)
    yield refused("leaf 0.005 mm", "leaf-a", ("Leaf spring/Thickness=0.005",), "Leaf spring/Thickness = 0.005: must be at least 0.0002 of")
    flat = ("Friction layer/Thickness=0.01", "Mesh/Face size=10")
    yield Row("elements 1000 times as long as high", "model-a", flat, deviation, "closed form", 0.005, warns=("coarse_contact",))
    yield Row("lever 0.5 mm", "model-a", ("Lever/Depth=0.5",), warns=("large_deflection",))
    check = forces(("Lever/Young's modulus=7e9",))
    yield Row("lever 200 mm", "model-a", (), check, "a lever 1e5 times as stiff", base=("Lever/Depth=200",))


def geometry_rows():
    near = A.locking(2.0) - 1e-6
    options = (f"Drive/Stroke={near!r}",)
    check = numbers(A.peaks(near, 2.0))
    yield Row("stroke 1e-6 mm before locking, rigid lever", "closed-form-a", (*options, *mu(2.0)), check, "eqs. 4 to 9", 1e-6)
    near = A.locking(2.0) + 1e-6
    yield refused("stroke 1e-6 mm beyond locking", "closed-form-a", (f"Drive/Stroke={near!r}", *mu(2.0)), "Drive/Stroke", "must not lock")
    near = B.pivot() - 1e-6
    options = (*GEOMETRY_B, f"Drive/Stroke={near!r}", *mu(0.5))
    check = numbers(B.peaks(near, 0.5))
    yield Row("stroke 1e-6 mm before the pivot, rigid lever", "closed-form-a", options, check, "eqs. 4 to 9", 1e-6)
    yield refused("stroke 1e-6 mm before the pivot", "model-b", options, "MPa, half of Young's modulus", status=1)
    options = (*GEOMETRY_B, f"Drive/Stroke={B.pivot() + 1e-6!r}")
    yield refused("stroke 1e-6 mm beyond the pivot", "model-b", options, "Drive/Stroke", "x must stay below 172.8 mm")
    for less in (1e-3, 1e-9):
        options = (f"Geometry/Interface offset={56 - less!r}", *mu(0.73))
        check = numbers(Device(e=56 - less).peaks(65.0, 0.73))
        yield Row(f"e = R - {less:g} mm, rigid lever", "closed-form-a", options, check, "eqs. 4 to 9", 1e-4)
    base = ("Geometry/Interface offset=55.9",)
    yield Row("e = R - 0.1 mm", "model-a", (), forces(FINE), "half the face size", 0.005, base=base)
    options = ("Geometry/Interface offset=55.999",)
    yield Row("e = R - 1e-3 mm", "model-a", options, deviation, "closed form", 0.05, warns=("coarse_contact",))
    for less in ("1e-9", "1e-14"):
        options = (f"Geometry/Interface offset={56 - float(less)!r}",)
        yield refused(f"e = R - {less} mm", "model-a", options, "Rotational spring/Stiffness", "must press harder")
    yield refused("e = R", "model-a", ("Geometry/Interface offset=56",), "Geometry/Interface offset", "less than Cylinder radius R")
    for radius in (1.0, 1e4):
        yield similar(radius / 56.0, f"R {radius:g} mm")


LENGTHS = {
    "Geometry/Cylinder radius": 56.0,
    "Geometry/Interface offset": 45.6,
    "Geometry/Pivot distance": 185.5,
    "Lever/Length": 350.0,
    "Lever/Depth": 20.0,
    "Lever/Width": 40.0,
    "Friction layer/Thickness": 1.0,
    "Drive/Stroke": 65.0,
    "Analysis/Step": 2.0,
    "Analysis/Minimum step": 1e-6,
    "Mesh/Face size": 0.5,
    "Contact/Penetration tolerance": 1e-6,
}


def similar(factor, name):
    """All lengths scaled, moduli as they are: forces go with the square."""
    scaled = [f"{parameter}={value * factor!r}" for parameter, value in LENGTHS.items()]
    scaled.append(f"Rotational spring/Stiffness={7.4e4 * factor**3!r}")
    check = forces((f"Lever/Length={LENGTHS['Lever/Length']}",), scale=factor**2, length=factor)
    return Row(name, "model-a", scaled, check, "model A, P times the square of R", base=mu(0.73))


def unit_rows():
    forces = {"Rotational spring/Stiffness": 7.4e4, "Lever/Young's modulus": 7e4, "Friction layer/Young's modulus": 20.0}
    forces |= {"Lever/Density": 2.7e-9, "Friction layer/Density": 2e-10, "Lever/Moment of inertia": 6.45}
    law = {"Contact/Stiffness": 9541.32}
    for factor, unit in ((1e3, "mN"), (1e-6, "MN")):
        scaled = tuple(f"{name}={value * factor!r}" for name, value in forces.items())
        scales = {"P": factor, "Q": factor}
        yield Row(f"forces in {unit}", "model-a", scaled, equal_rows((), scales=scales), "the run in N", 1e-6, base=SHORT)
        scaled += tuple(f"{name}={value * factor!r}" for name, value in law.items())
        yield Row(f"forces in {unit}, in time", "reversal-a", scaled, equal_rows((), scales=scales), "the run in N", 1e-6, base=BRIEF)
    in_ms = ("Lever/Density=2.7e-3", "Friction layer/Density=2e-4", "Lever/Moment of inertia=6.45e6", "Drive/Speed=0.112")
    in_ms += ("Drive/Reversal duration=5", "Time/Step=0.05", "Time/Tolerance=5e-3")
    yield Row("times in ms", "reversal-a", in_ms, equal_rows(()), "the run in s", 1e-6, base=(*BRIEF, *mu(0.73)))
    options = ("Geometry/Cylinder radius=0.056", "Geometry/Interface offset=0.0456")
    yield refused("lengths in m", "model-a", options, "Mesh/Face size", "must be", base=METRES)


METRES = ("Geometry/Pivot distance=0.1855", "Lever/Length=0.21", "Drive/Stroke=0.065", "Lever/Depth=0.02", "Lever/Width=0.04")
BRIEF = ("Drive/Start=60", "Drive/Stroke=61")
TIGHT = ("Time/Tolerance=5e-4",)


def inertia_rows():
    heavy = ("Lever/Moment of inertia=6.45e6",)
    yield Row("J 1e6 times, without inertia", "model-a", heavy, equal_rows(()), "J of model A", 0.0, base=SHORT)
    for factor in (1e-6, 1e6):
        J = 6.45 * factor
        for model in ("rigid", "condensed"):
            base = (*BRIEF, f"Lever/Moment of inertia={J!r}", f"Analysis/Model={model}", "Mesh/Face size=0.5")
            dear = model != "rigid" and factor < 1
            name = f"J {factor:g} times, {model}"
            yield Row(name, "reversal-a", (), peaks(TIGHT), "a tenth of Time/Tolerance", 0.02, base=base, slow=dear)
    light = (*BRIEF, "Analysis/Model=rigid", "Lever/Moment of inertia=6.45e-6", *mu(0.73))
    yield Row("J 1e-6 times, P", "reversal-a", light, quasi_static_in_time(0.3, 0.8), "P without inertia", 0.005)


def speed_rows():
    for speed in (1e-6, 1e4):
        check = equal_rows(())
        yield Row(f"speed {speed:g} mm/s", "coulomb-a", (f"Drive/Speed={speed!r}",), check, "112 mm/s, as mu is constant", 1e-6, base=SHORT)
    for model in ("rigid", "condensed"):
        base = ("Drive/Speed=1e4", "Drive/Reversal duration=1e-3", f"Analysis/Model={model}")
        yield Row(f"speed 1e4 mm/s in time, {model}", "reversal-a", (), peaks(TIGHT), "a tenth of Time/Tolerance", 0.02, base=base)
    yield refused("speed 1e-6 mm/s in time", "reversal-a", ("Drive/Speed=1e-6",), "Time/Step", "of which a run may have 1e+07")
    slow = ("Drive/Speed=1e-6", "Time/Step=2e3", "Time/Tolerance=5e-3", *mu(0.73))
    check = quasi_static_in_time(0.45, 0.7)
    yield Row("speed 1e-6 mm/s in time, steps of 2000 s", "reversal-a", slow, check, "P without inertia", 0.005, base=BRIEF)
    fast = ("Drive/Speed=1e4",)
    yield refused("speed 1e4 mm/s, reversal of 5 ms", "reversal-a", fast, "Drive/Reversal duration = 5e-3: must be at most", base=BRIEF)
    ideal = ("Analysis/Model=rigid", "Contact/Type=ideal", "Drive/Reversal duration=0")
    yield refused("reversal 0, ideal contact", "reversal-a", ideal, "Drive/Reversal duration", "infinite", base=BRIEF)
    for model in ("rigid", "condensed"):
        base = (*BRIEF, f"Analysis/Model={model}", "Mesh/Face size=0.5")
        check = peaks(("Drive/Reversal duration=1e-9",))
        yield Row(f"reversal 0, {model}", "reversal-a", ("Drive/Reversal duration=0",), check, "1e-9 s", 0.01, base=base)
    long = ("Drive/Reversal duration=1", "Drive/Speed=2", *mu(0.73))
    check = quasi_static_in_time(0.4, 0.65)
    yield Row("reversal 1 s", "reversal-a", long, check, "P without inertia", 0.01, base=BRIEF)


def long_rows():
    cycles = ("Drive/Start=60", "Drive/Stroke=60.5", "Drive/Cycles=300", *mu(0.73))
    coarse = ("Mesh/Face size=2", "Mesh/Faces in contact=0", "Analysis/Step=0.5")
    yield Row("300 cycles", "model-a", (*cycles, *coarse), closes, "the 30th cycle", 1e-8, timeout=1500, slow=True)
    for model, number in (("rigid", 300), ("condensed", 100)):
        options = (*cycles, f"Drive/Cycles={number}", f"Analysis/Model={model}", "Mesh/Face size=2")
        # Ringing in contact lasts 6 ms a period: in steps of 4 ms Newton's method fails about once a cycle, round-off says where.
        options += ("Drive/Speed=5", "Drive/Reversal duration=0.02", "Time/Step=2e-3")
        limit = 1e-8 if model == "rigid" else 1e-7  # of the forces Newton's method leaves 1e-8
        yield Row(f"{number} cycles in time, {model}", "reversal-a", options, closes, "the 30th cycle", limit, timeout=1500, slow=True)
    steps = ("Time/Step=3.6e-6", "Analysis/Model=rigid")
    check = peaks(("Time/Tolerance=1e-3", "Analysis/Model=rigid"))
    yield Row("1e5 steps in time", "reversal-a", steps, check, "adaptive steps", 1e-3, timeout=1500, slow=True)


KINDS = (friction_rows, penalty_rows, step_rows, part_rows, geometry_rows, unit_rows, inertia_rows, speed_rows, long_rows)
ROWS = [row for kind in KINDS for row in kind()]
