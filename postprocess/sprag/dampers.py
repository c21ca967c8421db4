# SPDX-License-Identifier: GPL-3.0-only
"""Ranks dampers of an isolated table, each at its own best strength or at the same largest displacement."""

import math
from functools import partial
from typing import NamedTuple

import numpy as np

from .program import Scene, run, sweep

STRENGTHS = {
    "constant friction": "Isolation/Friction force",
    "linear friction": "Isolation/Friction slope",
    "viscous": "Isolation/Viscous coefficient",
    "lever": "Rotational spring/Stiffness",
}
RANGE, FIRST_TRIES = 1024.0, 11  # strongest over weakest, and how many are tried first


class RankedDamper(NamedTuple):
    """A damper, its strength, and what a run with it found."""

    damper: str
    strength: float  # value of STRENGTHS[damper], in `unit`; 0 without a damper
    unit: str
    transmissibility: float  # root mean square of the table's acceleration over the base's
    displacement: float  # largest of the table over the base [mm]
    note: str = ""

    def __str__(self):
        strength = f" ({STRENGTHS[self.damper]} {self.strength:.3g} {self.unit}{self.note})" if self.unit else ""
        return f"{self.damper}{strength} lets through {self.transmissibility:.3g}, moves up to {self.displacement:.3g} mm"


def rank_dampers(scene, changes=None, displacement=None, jobs=None):
    """The RankedDampers of a scene's table on its moving base, that which lets the least through first, and for comparison those of no
    damper and of the lever as it is: two lists.

    Without a displacement each damper has the strength that lets the least through; the lever's is the stiffness of its rotational
    spring. With one [mm] each has the least strength that keeps the table within it; dampers that cannot are left out. Strengths are
    found within 5 %. Throws Refused or Failed, ValueError where the base is at rest.
    """
    changes = {**(changes or {}), "Analysis/Type": "isolation"}
    known = Scene(scene.path, {**scene.changes, **changes}) if isinstance(scene, Scene) else Scene(scene, changes)
    mass, stiffness, lever = (known.parameters[name].number for name in ("Isolation/Mass", "Isolation/Stiffness", STRENGTHS["lever"]))
    free = run(known, {"Isolation/Damper": "none"})
    if not np.isfinite(free.summary["transmissibility_rms"]):
        raise ValueError("dampers are ranked by what they let through: Isolation/Base motion must not be none")
    strongest = {
        "constant friction": mass * np.abs(free.table["base_acceleration"]).max(),  # holds the table
        "linear friction": stiffness,
        "viscous": 2 * math.sqrt(mass * stiffness),  # critical damping
        "lever": math.sqrt(RANGE) * lever,
    }

    def try_strengths(damper, strengths):
        table = sweep(known, {STRENGTHS[damper]: strengths}, {"Analysis/Type": "isolation", "Isolation/Damper": damper}, jobs=jobs).table
        return table["transmissibility_rms"], table["largest_displacement"]

    ranked = []
    for damper, most in strongest.items():
        if found := find_strength(partial(try_strengths, damper), most, displacement):
            strength, through, largest = found
            is_at_end = any(math.isclose(strength, end, rel_tol=0.05) for end in (most / RANGE, RANGE * most))
            note = ", where the range tried ends" if is_at_end else ""
            ranked.append(RankedDamper(damper, strength, known.parameters[STRENGTHS[damper]].unit, through, largest, note))
    without = RankedDamper("no damper", 0.0, "", float(free.summary["transmissibility_rms"]), float(free.summary["largest_displacement"]))
    through, largest = (float(column[0]) for column in try_strengths("lever", [lever]))
    as_it_is = RankedDamper("lever", lever, known.parameters[STRENGTHS["lever"]].unit, through, largest, ", as it is")
    return sorted(ranked, key=lambda each: each.transmissibility), [without, as_it_is]


def find_strength(try_strengths, strongest, displacement):
    """Returns strength, transmissibility and displacement; None where no strength serves.

    Where the strongest tried is the best, or none serves, stronger ones are tried, up to RANGE times `strongest`.
    """
    lowest, highest = strongest / RANGE, strongest
    strengths, narrowed = np.geomspace(lowest, highest, FIRST_TRIES), 0
    while narrowed < 3:
        through, largest = try_strengths(strengths)
        serves = np.isfinite(through) if displacement is None else largest <= displacement
        best = None
        if serves.any():
            best = int(np.nanargmin(through) if displacement is None else np.argmax(serves))
            found = float(strengths[best]), float(through[best]), float(largest[best])
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
    return "\n".join([*lines, verdict])
