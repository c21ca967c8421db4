# SPDX-License-Identifier: GPL-3.0-only
"""Boundaries in maps of stability."""

import unittest

import numpy as np

from real_results import real_result
import map as stability


class MapTest(unittest.TestCase):
    def test_boundaries_part_stable_points_from_others(self):
        """Between any two neighbours in depth of which one alone is stable a line of the boundary passes."""
        result = real_result("map-friction-depth-a")
        points = result.groups["map"]
        for way, direction in (("forward", 1), ("backward", -1)):
            kind = points[f"kind_{way}"]
            lines = stability.boundary_lines(result, stability.read_map(result), direction)
            ends = [end for group in lines.values() for line in group for end in np.transpose(line)]
            for i, j in zip(*np.nonzero((kind[:, 1:] == 0) != (kind[:, :-1] == 0))):
                low, high = points["second"][j : j + 2]
                self.assertTrue(any(np.isclose(end[0], points["first"][i]) and low <= end[1] <= high for end in ends), (way, i, j))

    def test_a_corner_is_cut(self):
        # A circle about the origin: a point on the lower side of the quad (0, 0), one on its left side.
        lines = stability.segments(([0.6, 0.0], [0.0, 0.7], [1, 2], [1, 1], [0, 0]))
        self.assertEqual(lines[1], [[(0.6, 0.0), (0.0, 0.7)]])

    def test_three_kinds_meet_in_a_point(self):
        lines = stability.segments(([0.5, 0.0, 1.0], [0.0, 0.5, 0.5], [1, 2, 2], [0, 0, 1], [1, 3, 3]))
        middle = (0.5, 1 / 3)
        found = sorted(tuple(np.round(end, 12)) for end in [line[1] for kind in (1, 3) for line in lines[kind]])
        self.assertEqual(found, [tuple(np.round(middle, 12))] * 3)
