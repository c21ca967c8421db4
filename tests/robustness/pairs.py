# SPDX-License-Identifier: GPL-3.0-only
"""A full pair whose levers differ is judged alike whichever of them comes first; run with /usr/bin/python3; environment: SPRAG, the
program, and SPRAG_SOURCE, the sources."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, RunTest, sprag  # noqa: E402

DEVICE = (
    "Mirrored pair/Type=full", "Mirrored pair/Joint=held", "Friction/Law=Coulomb", "Geometry/Cylinder radius=40", "Geometry/Interface offset=25", "Geometry/Pivot distance=150",
    "Geometry/Pivot height=0", "Rotational spring/Stiffness=5e4", "Lever/Depth=20", "Lever/Length=170", "Lever/Width=30", "Lever/Moment of inertia=2.5", "Drive/Stroke=40",
    "Drive/Speed=40", "Output/Fields=none",
)  # fmt: skip
BEAM = (*DEVICE, "Analysis/Model=beam", "Contact/Stiffness=3000")
SLIDE = ("Analysis/Type=stability", "Stability/Critical=none", "Stability/Roles=off")

# Options; name and ratio of what differs between the levers, with the first lever's parameter and its value; names in /summary
# of equal values, where motions are irregular within 2 %, and some of the warnings.
CASES = {
    "cycle": ((*BEAM, "Analysis/Type=sprag slip", "Stability/Position=30", "Stability/Direction=forward", "Sprag slip/Continuation=0", "Sprag slip/Longest growth=0.1", "Sprag slip/Settling time=0.1", "Sprag slip/Steps per period=32"), ("Friction ratio", 4.5, "Friction/Coefficient", 0.8), ("cycle", "cycle_amplitude_P", "cycle_relative_amplitude", "measured_growth_rate"), None),
    "reversal": ((*BEAM, "Analysis/Type=transient"), ("Friction ratio", 4.5, "Friction/Coefficient", 0.8), ("reversal_1_verdict", "reversal_1_frequency", "reversal_1_P_scale", "swing_P"), ["pressure_beyond_strength"]),
    "margin": ((*BEAM, *SLIDE, "Stability/Position=30", "Stability/Direction=backward"), ("Friction ratio", 4., "Friction/Coefficient", 0.8), ("margin", "growth_rate", "verdict"), None),
    "half a layer": ((*DEVICE, *SLIDE, "Analysis/Model=rigid", "Contact/Stiffness=3000", "Stability/Position=30", "Stability/Direction=forward"), ("Contact ratio", 0.005, "Contact/Stiffness", 3000.), ("verdict",), None),
    "strokes": ((*DEVICE, "Analysis/Type=quasi-static", "Mesh/Face size=4", "Analysis/Step=2", "Lever/Depth=8"), ("Friction ratio", 4., "Friction/Coefficient", 0.8), ("deviation_P_forward", "deviation_Q_forward", "deviation_theta_forward", "deviation_P_backward"), ["pressure_beyond_strength"]),
}  # fmt: skip


class PairTest(RunTest):
    def judged(self, name, options):
        folder = self.folder / name
        run = sprag(SOURCE / "params" / "model-a.prm", *[part for option in options for part in ("--set", option)], "--output", folder)
        self.assertIn(run.returncode, (0, 1), run.stdout + run.stderr)
        with h5py.File(folder / "result.h5") as result:
            summary = {entry: value[()] for entry, value in result["summary"].items()}
            return summary, set(result["warnings"])

    def test_levers_may_be_exchanged(self):
        for name, (options, (ratio, value, parameter, first), entries, warned) in CASES.items():
            with self.subTest(name):
                one, one_warnings = self.judged(f"{name}-1", (*options, f"{parameter}={first}", f"Mirrored pair/{ratio}={value}"))
                other, other_warnings = self.judged(f"{name}-2", (*options, f"{parameter}={first * value}", f"Mirrored pair/{ratio}={1 / value}"))
                self.assertEqual(one_warnings, other_warnings)
                self.assertLessEqual(set(warned or ()), one_warnings)
                for entry in entries:
                    if isinstance(one[entry], bytes):
                        self.assertEqual(one[entry], other[entry], entry)
                    else:
                        np.testing.assert_allclose(one[entry], other[entry], rtol=0.02, atol=1e-9, err_msg=entry)


if __name__ == "__main__":
    unittest.main()
