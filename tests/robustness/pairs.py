# SPDX-License-Identifier: GPL-3.0-only
"""A full pair whose levers differ is judged alike whichever of them comes first."""

import math

import h5py
import numpy as np

from runs import SOURCE, RunTest, sprag

DEVICE = (
    "Mirrored pair/Type=full", "Mirrored pair/Joint=held", "Friction/Law=Coulomb", "Geometry/Cylinder radius=40", "Geometry/Interface offset=25", "Geometry/Pivot distance=150",
    "Geometry/Pivot height=0", "Rotational spring/Stiffness=5e4", "Lever/Depth=20", "Lever/Length=170", "Lever/Width=30", "Lever/Moment of inertia=2.5", "Drive/Stroke=40",
    "Drive/Speed=40", "Output/Fields=none",
)  # fmt: skip
BEAM = (*DEVICE, "Analysis/Model=beam", "Contact/Stiffness=3000")
SLIDE = ("Analysis/Type=stability", "Stability/Critical=none", "Stability/Roles=off")


def mu(first, ratio):
    return f"Friction/Coefficient={first}", f"Mirrored pair/Friction ratio={ratio}"


# Options; those that name the levers in either order; entries of /summary that have to be equal, where motions are irregular within
# 2 %, with their values where these are known otherwise; and some of the warnings. A rigid lever's margin on the way back is
# 1 - mu e/s, with s^2 = (l - x)^2 + h^2 - (R - e)^2.
MARGIN = 1.0 - 3.2 * 25 / math.sqrt(120**2 - 15**2)
CASES = {
    "cycle": (
        (*BEAM, "Analysis/Type=sprag slip", "Stability/Position=30", "Stability/Direction=forward", "Sprag slip/Continuation=0", "Sprag slip/Longest growth=0.1", "Sprag slip/Settling time=0.1", "Sprag slip/Steps per period=32"),
        (mu(0.8, 4.5), mu(3.6, 1 / 4.5)), {"cycle": b"irregular", "cycle_amplitude_P": None, "cycle_relative_amplitude": None, "measured_growth_rate": None}, (),
    ),
    "reversal": ((*BEAM, "Analysis/Type=transient"), (mu(0.8, 4.5), mu(3.6, 1 / 4.5)), {"reversal_1_verdict": b"vibrates", "reversal_1_P_scale": None, "swing_P": None}, ("pressure_beyond_strength",)),
    "margin": ((*DEVICE, *SLIDE, "Analysis/Model=rigid", "Contact/Stiffness=3000", "Stability/Position=30", "Stability/Direction=backward"), (mu(0.8, 4.), mu(3.2, 0.25)), {"margin": MARGIN, "growth_rate": None}, ()),
    "half a layer": (
        (*DEVICE, *SLIDE, "Analysis/Model=rigid", "Stability/Position=30", "Stability/Direction=forward"),
        (("Contact/Stiffness=3000", "Mirrored pair/Contact ratio=0.005"), ("Contact/Stiffness=15", "Mirrored pair/Contact ratio=200")), {"verdict": b"jammed"}, (),
    ),
    "one open": (
        (*DEVICE, *SLIDE, "Analysis/Model=rigid", "Contact/Stiffness=3000", "Stability/Position=4", "Stability/Direction=forward"),
        (("Mirrored pair/Cylinder offset=2",), ("Mirrored pair/Cylinder offset=-2",)), {"verdict": b"stable", "growth_rate": None, "margin": None}, (),
    ),
    "strokes": ((*DEVICE, "Analysis/Type=quasi-static", "Mesh/Face size=4", "Analysis/Step=2", "Lever/Depth=8"), (mu(0.8, 4.), mu(3.2, 0.25)), dict.fromkeys(("deviation_P_forward", "deviation_Q_forward", "deviation_theta_forward", "deviation_P_backward")), ("pressure_beyond_strength",)),
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
        for name, (options, orders, entries, warned) in CASES.items():
            with self.subTest(name):
                (one, one_warnings), (other, other_warnings) = [self.judged(f"{name} {i}", (*options, *order)) for i, order in enumerate(orders)]
                self.assertEqual(one_warnings, other_warnings)
                self.assertLessEqual(set(warned), one_warnings)
                for entry, value in entries.items():
                    if isinstance(one[entry], bytes):
                        self.assertEqual((one[entry], other[entry]), (value, value), entry)
                    else:
                        np.testing.assert_allclose(one[entry], [other[entry], one[entry] if value is None else value], rtol=0.02, atol=1e-9, err_msg=entry)
