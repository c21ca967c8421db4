# SPDX-License-Identifier: GPL-3.0-only
"""Shapes and names of modes, bars of roles and branches of a continuation."""

import numpy as np

from pictures import PictureTest
from real_results import real_result
import sprag_slip
import vibration
from style import plt


def named_modes(*eigenvalues):
    eigenvalues = np.array(eigenvalues, dtype=complex)
    kind = np.where(eigenvalues.real > 0, np.where(eigenvalues.imag > 0, 1, 2), 0)
    return {"frequency": eigenvalues.imag / (2 * np.pi), "growth_rate": eigenvalues.real, "kind": kind}


class Vibration(PictureTest):
    def test_deflection_turns_with_the_hub(self):
        modes = real_result("stability-a").groups["modes"]
        xi, (shape,) = vibration.deflections(modes, 0)
        order = np.argsort(modes["xi"])
        np.testing.assert_array_equal(xi, np.asarray(modes["xi"])[order])
        moved = [(np.asarray(modes[f"across_{part}"][0]) + modes[f"rotation_{part}"][0] * np.asarray(modes["xi"]))[order] for part in ("real", "imaginary")]
        whole = moved[0] + 1j * moved[1]
        np.testing.assert_allclose(shape, whole / whole[np.abs(whole).argmax()], atol=1e-12)

    def test_both_levers_of_a_pair_are_named_by_their_motion(self):
        modes = real_result("pair-stability-a").groups["modes"]
        for mode, share in enumerate(modes["mirroring"]):
            _, (first, second) = vibration.deflections(modes, mode)
            self.assertAlmostEqual(max(np.abs(first).max(), np.abs(second).max()), 1, 9)
            if abs(share) > 0.9:
                name = "mirroring" if share > 0 else "swinging"
                self.assertTrue(vibration.mode_name(modes, mode).endswith(f", {name}"), vibration.mode_name(modes, mode))

    def test_names_of_modes(self):
        modes = named_modes(-1234 + 2000j * np.pi, 0.5 + 200j * np.pi, 40 + 0j)
        names = [vibration.mode_name(modes, mode) for mode in range(3)]
        minus = "\N{MINUS SIGN}"
        self.assertEqual(names, [f"1000 Hz, {minus}1234 1/s", "100 Hz, +0.5 1/s, flutter", "0 Hz, +40 1/s, divergence"])

    def test_branches_jump(self):
        """From slide to vibration no line is drawn but dots."""
        x = np.array((3.0, 1, 2, 4, 5))
        points = {"x": x, "kind_away": np.array((1.0, 0, 0, 2, np.nan)), "amplitude_P_away": 10 * x}
        _, axes = plt.subplots()
        sprag_slip.draw_branch(axes, points, "away", "name", "o", 0)
        lines = [(line.get_linestyle(), *line.get_ydata()) for line in axes.get_lines() if len(line.get_xdata()) == 2]
        self.assertEqual(lines, [("-", 0, 0), (":", 0, 30), ("-", 30, 40)])
        hollow = [line for line in axes.get_lines() if line.get_markerfacecolor() == "white"]
        self.assertEqual([list(line.get_ydata()) for line in hollow], [[40]])
