# SPDX-License-Identifier: GPL-3.0-only
"""Runs scenes of params/, each once a process, with settings that take a second or so."""

import os
import tempfile
from functools import lru_cache
from pathlib import Path

from pictures import SOURCE
from sprag import program
from sprag.results import read_result

SCENES = Path(os.environ.get("SPRAG_SOURCE", SOURCE)) / "params"
COARSE = {"Mesh/Face size": 2}
WITHOUT_FIELDS = {**COARSE, "Output/Fields": "none"}
FRAMES = {**COARSE, "Output/Fields": "interval", "Output/Field interval": 10, "Drive/Stroke": 40, "Analysis/Step": 2}
SOLID = {**COARSE, "Mesh/Faces in contact": 0, "Mesh/Elements across": 2, "Analysis/Step": 10, "Drive/Cycles": 0.5}
# Scene and changes of the results whose name is not that of a scene, or whose scene is changed.
CHANGES = {
    "lever with frames": ("model-a", FRAMES),
    "apparatus with frames": ("apparatus-a", FRAMES),
    "solid with frames": ("model-a", {**SOLID, **FRAMES, "Analysis/Dimension": 3}),
    "fig11": ("fig11", {"Slope/Offset ratios": ", ".join(f"{i / 12:g}" for i in range(11))}),
    "model-b": ("model-b", WITHOUT_FIELDS),
    "pair-a": ("pair-a", COARSE),
    "pair in time": ("pair-reversal-a", {"Analysis/Model": "beam"}),
    "solid-pair-a": ("solid-pair-a", SOLID),
    "plate-a": ("plate-a", WITHOUT_FIELDS),
    "plate-reversal-a": ("plate-reversal-a", COARSE),
    "stability-a": ("stability-a", {"Stability/Position": "auto", "Stability/Direction": "both", "Stability/Critical": "Lever/Depth 3 25"}),
    "pair-stability-a": ("pair-stability-a", {"Stability/Critical": "Friction/Factor 0.9 1.1"}),
    "jammed": ("stability-a", {"Friction/Factor": 8, "Lever/Depth": 20, "Stability/Critical": "none"}),
    **{f"stability-b of {depth}": ("stability-b", {"Lever/Depth": depth, "Stability/Critical": "none"}) for depth in (8, 16)},
    **{f"reversal-a of {depth}": ("reversal-a", {"Lever/Depth": depth}) for depth in (6, 12, 20)},
    "onset-a": ("onset-a", {"Sprag slip/Continuation": 2}),
    "modal-a": ("modal-a", COARSE),
    "calibration-a": ("calibration-a", {"Mesh/Face size": 4}),
    "contact-law-a": ("contact-law-a", COARSE),
    "map-friction-depth-a": ("map-friction-depth-a", {"Map/First points": 4, "Map/Second points": 4, "Map/Coarsest": 1, "Map/Bisections": 1}),
    "isolation-free-a": ("isolation-free-a", {"Isolation/Damper": "constant friction"}),
    "isolation-ground-a": ("isolation-ground-a", {"Isolation/Duration": 20}),
    "study-transmissibility-a": (
        "study-transmissibility-a",
        {"Study/Vary": "Isolation/Damper = lever, constant friction, Beucke; Isolation/Base frequency = 0.5 ... 2 : 9"},
    ),
    "study-a": ("study-a", {"Study/Vary": "Mesh/Degree = 1, 2; Mesh/Face size = 2, 3, 4", "Study/Reference": "Mesh/Face size = 1"}),
    "study of many": (
        "study-a",
        {"Analysis/Model": "closed form", "Study/Vary": "Lever/Depth = 10 ... 20 : 11; Geometry/Pivot height = 0, 1; Friction/Factor = 1, 1.1"},
    ),
    "refused in part": ("study-a", {"Analysis/Model": "closed form", "Study/Vary": "Friction/Law = Coulomb, table"}),
    "judged": ("design-a", {"Design/Judges": "beam"}),
    "front": (
        "design-a",
        {"Design/Judges": "none", "Design/Demands": "damping slope = 0.1 +- 0.001; jamming margin >= 0.5", "Design/Second aim": "minimise largest force",
         "Design/Front points": 4, "Design/Evaluations": 200},
    ),
}  # fmt: skip


@lru_cache
def shared_folder():
    return tempfile.TemporaryDirectory(prefix="sprag-test-")


@lru_cache
def run_once(name):
    """Returns the folder of the result."""
    scene, changes = CHANGES.get(name, (name, {}))
    folder = Path(shared_folder().name) / name
    program.run_scene(program.program(), SCENES / f"{scene}.prm", folder, changes)
    return folder


def real_result(name):
    """The result of a name of CHANGES or of a scene, read anew so that a test may change it."""
    return read_result(run_once(name))
