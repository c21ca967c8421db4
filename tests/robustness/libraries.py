# SPDX-License-Identifier: GPL-3.0-only
"""The big libraries, which take 0.2 CPU s to load, are loaded for models alone and not for looks at a scene and formulas.
Environment beside that of all: SPRAG_BUILD_TYPE; checks of another than Release take deal.II's library everywhere."""

import os
import re
import unittest
from pathlib import Path

from runs import SOURCE, RunTest, sprag

BIG = re.compile(r"lib(deal\.ii|petsc|slepc|gmsh|TK|dmumps)")
MOST_LIBRARIES = 80  # HDF5 with MPI takes some 50

LIGHT = {
    "version": (None, "--version"),
    "check of model A's closed form": ("closed-form-a", "--validate"),
    "check of a beam that tells no cost": ("reversal-a", "--validate", "--quiet"),
    "parameters of a mesh": ("model-a", "--print-parameters"),
    "closed form": ("closed-form-a",),
    "closed form of a pair": ("pair-a", "--set", "Analysis/Model=closed form"),
    "closed form in time": ("reversal-a", "--set", "Analysis/Model=closed form"),
    "ideal contact of a rigid lever": ("reversal-a", "--set", "Analysis/Model=rigid", "--set", "Contact/Type=ideal"),
    "slope": ("fig10",),
    "levers of an isolation system": ("isolation-a",),
}
HEAVY = {
    "beam": ("reversal-a",),
    "check of a beam, whose steps are counted": ("reversal-a", "--validate"),
    "check of a mesh": ("model-a", "--validate"),
    "check of a leaf spring": ("leaf-a", "--set", "Analysis/Model=closed form", "--validate"),
}


@unittest.skipUnless(os.environ.get("SPRAG_BUILD_TYPE", "Release") == "Release", "other builds check with deal.II")
class Libraries(RunTest):
    def loaded(self, scene, *options):
        """Names of all libraries that the loader put into the program and whatever it started or became."""
        log = self.folder / "loader"
        log.mkdir()
        arguments = [] if scene is None else [SOURCE / "params" / f"{scene}.prm", "--output", self.output]
        environment = {**os.environ, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(log / "of")}
        run = sprag(*arguments, *options, env=environment)
        self.assertEqual(run.returncode, 0, run.stderr)
        text = "".join(path.read_text(errors="replace") for path in log.iterdir())
        return {Path(path).name for path in re.findall(r"calling init: (\S+)", text)}

    def test_formulas_and_looks_at_a_scene_load_no_big_library(self):
        for name, command in LIGHT.items():
            with self.subTest(name):
                self.setUp()
                libraries = self.loaded(*command)
                self.assertTrue(any(library.startswith("libhdf5") for library in libraries), libraries)
                self.assertEqual([library for library in libraries if BIG.match(library)], [])
                self.assertLess(len(libraries), MOST_LIBRARIES)

    def test_models_load_them(self):
        for name, command in HEAVY.items():
            with self.subTest(name):
                self.setUp()
                self.assertTrue(any(library.startswith("libdeal.ii") for library in self.loaded(*command)))
