# SPDX-License-Identifier: GPL-3.0-only
"""Ranks dampers of an isolated table, each at its own best strength or at the same largest displacement."""

import math
from functools import partial
from os import PathLike
from typing import Any, Mapping, NamedTuple, Optional, Union

import numpy as np

from .program import Scene, run, sweep

STRENGTHS = {
    "constant friction": "Isolation/Friction force",
    "linear friction": "Isolation/Friction slope",
    "viscous": "Isolation/Viscous coefficient",
    "lever": "Rotational spring/Stiffness",
}
RANGE, FIRST_TRIES = 1024.0, 11  # strongest over weakest, and how many are tried first
LONGEST = 4  # times Isolation/Duration, until which a motion over a harmonic base has time to become steady
STEADY = {"Isolation/End": "steady state", "Isolation/Periodic tolerance": 1e-3}


class RankedDamper(NamedTuple):
    """A damper, its strength, and what a run with it found."""

    damper: str
    strength: float  # value of STRENGTHS[damper], in `unit`; 0 without a damper
    unit: str
    transmissibility: float  # root mean square of the table's acceleration over the base's
    displacement: float  # largest of the table over the base [mm]
    note: str = ""
    is_steady: bool = True  # False: over a harmonic base the motion still changes, and so does what comes through

    def __str__(self):
        strength = f" ({STRENGTHS[self.damper]} {self.strength:.3g} {self.unit}{self.note})" if self.unit else ""
        ending = "" if self.is_steady else ", not steady"
        return f"{self.damper}{strength} lets through {self.transmissibility:.3g}, moves up to {self.displacement:.3g} mm{ending}"


def rank_dampers(
    scene: Union[Scene, str, PathLike],
    changes: Optional[Mapping[str, Any]] = None,
    displacement: Optional[float] = None,
    jobs: Optional[int] = None,
) -> tuple[list[RankedDamper], list[RankedDamper]]:
    """The RankedDampers of a scene's table on its moving base, that which lets the least through first and those that are not steady last, and for comparison those of no
    damper and of the lever as it is: two lists.

    Without a displacement each damper has the strength that lets the least through; the lever's is the stiffness of its rotational
    spring. With one [mm] each has the least strength that keeps the table within it; dampers that cannot are left out. Strengths are
    found within 5 %. Throws Refused or Failed, ValueError where the base is at rest.
    """
    changes = {**(changes or {}), "Analysis/Type": "isolation"}
    known = Scene(scene.path, {**scene.changes, **changes}) if isinstance(scene, Scene) else Scene(scene, changes)
    mass, stiffness, lever = (known.parameters[name].number for name in ("Isolation/Mass", "Isolation/Stiffness", STRENGTHS["lever"]))
    is_harmonic, duration = known.parameters["Isolation/Base motion"].text == "harmonic", known.parameters["Isolation/Duration"].number
    free = run(known, {"Isolation/Damper": "none"})
    if not np.isfinite(free.summary["transmissibility_rms"]):
        raise ValueError("dampers are ranked by what they let through: Isolation/Base motion must not be none")
    strongest = {
        "constant friction": mass * np.abs(free.table["base_acceleration"]).max(),  # holds the table
        "linear friction": stiffness,
        "viscous": 2 * math.sqrt(mass * stiffness),  # critical damping
        "lever": math.sqrt(RANGE) * lever,
    }

    steady = {"Isolation/Duration": LONGEST * duration, **STEADY} if is_harmonic else {}

    def try_strengths(damper, strengths):
        runs = {"Analysis/Type": "isolation", "Isolation/Damper": damper, **steady}
        table = sweep(known, {STRENGTHS[damper]: strengths}, runs, jobs=jobs).table
        return table["transmissibility_rms"], table["largest_displacement"], table["steady_state"] == 1 if is_harmonic else np.isfinite(strengths)

    ranked = []
    for damper, most in strongest.items():
        if found := find_strength(partial(try_strengths, damper), most, displacement):
            strength, through, largest, is_steady = found
            is_at_end = any(math.isclose(strength, end, rel_tol=0.05) for end in (most / RANGE, RANGE * most))
            note = ", where the range tried ends" if is_at_end else ""
            ranked.append(RankedDamper(damper, strength, known.parameters[STRENGTHS[damper]].unit, through, largest, note, is_steady))
    through, largest = (float(free.summary[name]) for name in ("transmissibility_rms", "largest_displacement"))
    without = RankedDamper("no damper", 0.0, "", through, largest, is_steady=free.summary.get("steady_state", 1) == 1)
    through, largest, is_steady = (column[0].item() for column in try_strengths("lever", np.array([lever])))
    as_it_is = RankedDamper("lever", lever, known.parameters[STRENGTHS["lever"]].unit, through, largest, ", as it is", is_steady)
    return sorted(ranked, key=lambda each: (not each.is_steady, each.transmissibility)), [without, as_it_is]


def find_strength(try_strengths, strongest, displacement):
    """Returns strength, transmissibility, displacement and whether the motion is steady; None where no strength serves.

    Where the strongest tried is the best, or none serves, stronger ones are tried, up to RANGE times `strongest`.
    """
    lowest, highest = strongest / RANGE, strongest
    strengths, narrowed = np.geomspace(lowest, highest, FIRST_TRIES), 0
    while narrowed < 3:
        through, largest, is_steady = try_strengths(strengths)
        counted = np.where(is_steady, through, np.nan) if (is_steady & np.isfinite(through)).any() else through
        serves = np.isfinite(counted) if displacement is None else largest <= displacement
        best = None
        if serves.any():
            best = int(np.nanargmin(counted) if displacement is None else np.argmax(serves))
            found = float(strengths[best]), float(through[best]), float(largest[best]), bool(is_steady[best])
        if narrowed == 0 and best in (None, len(strengths) - 1) and highest < RANGE * strongest:
            lowest, highest = strengths[-2], highest * math.sqrt(RANGE)
            strengths = np.geomspace(lowest, highest, FIRST_TRIES)
            continue
        if best is None:
            return None
        narrowed += 1
        after = best + 1 if displacement is None else best
        strengths = np.geomspace(strengths[max(best - 1, 0)], strengths[min(after, len(strengths) - 1)], 9)
    return found


def tell_ranking(ranked, compared):
    """Returns the ranking in words, with the lever's place even where it loses."""
    lines = [f"{place}. {each}" for place, each in enumerate(ranked, 1)] + [f"   {each}" for each in compared]
    missing = [damper for damper in STRENGTHS if damper not in {each.damper for each in ranked}]
    lines += [f"   {damper}: none of the strengths tried serves" for damper in missing]
    lever = next((each for each in ranked if each.damper == "lever"), None)
    if lever is None:
        verdict = "The lever does not keep the table within that displacement."
    elif lever == ranked[0]:
        verdict = "The lever lets the least through."
    else:
        verdict = f"The lever lets through {lever.transmissibility:.3g}, {ranked[0].damper} {ranked[0].transmissibility:.3g}."
    if not all(each.is_steady for each in ranked):
        verdict += " What dampers that are not steady let through still changes: they are ranked last, and need a longer Isolation/Duration."
    return "\n".join([*lines, verdict])
