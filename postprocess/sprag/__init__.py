# SPDX-License-Identifier: GPL-3.0-only
"""Runs sprag and reads its results.

    import sprag

    result = sprag.run("params/model-a.prm", {"Drive/Stroke": 40})
    result.table["Q"], result.table["Q"].unit            # a column, "N"
    result.summary["slope_forward"].unit                 # "N/mm"
    result.face(30, "backward").pressure                 # MPa, at the points .xi [mm]
    result.fields(0)["von_mises_stress"]                 # MPa, at the nodes ["nodes"] [mm]
    sprag.sweep("params/model-a.prm", {"Lever/Depth": [6, 8, 10]}).to_pandas()
    scene = sprag.Scene("params/model-a.prm")
    scene.lever.depth, scene.lever.depth.range           # a Parameter, "a number > 0"
    scene.lever.depth = 12                               # for sprag.run(scene)
    sprag.read("output/model-a")                         # a result that is there already

Units are mm, N, s, t and rad, hence MPa and N mm. A Refused or Failed holds the program's message.
"""

from .dampers import rank_dampers, tell_ranking
from .program import Failed, Refused, RunFailed, Scene, Section, run, sweep
from .results import FaceState, NotAResult, Result, read_result as read

__all__ = ["Failed", "FaceState", "NotAResult", "Refused", "Result", "RunFailed", "Scene", "Section", "rank_dampers", "read", "run", "sweep", "tell_ranking"]
