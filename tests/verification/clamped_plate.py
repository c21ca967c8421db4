#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-only
"""A leaf spring as a plate of Kirchhoff's theory, clamped at one end and turned at the other, over the beam's 4 EI/L: the number in
params/models.md. A Ritz solution, which is too stiff by 1e-5: cubic of the beam, (1 - s^2)^2 P_i(s) P_2j(t) along and across.

    /usr/bin/python3 tests/verification/clamped_plate.py     # prints the ratio for the leaf of model A
"""
import numpy as np
from numpy.polynomial import legendre, polynomial


def stiffness_ratio(length: float, width: float, nu: float, n_along: int = 24, n_across: int = 12) -> float:
    """k of the plate over that of the beam."""
    s, s_weight = legendre.leggauss(n_along + 8)
    t, t_weight = legendre.leggauss(2 * n_across + 6)
    turn = legendre.poly2leg(0.5 * length * polynomial.polymul([1, 1], polynomial.polypow([0.5, -0.5], 2)))  # slope 1 at s = -1
    bubble = legendre.poly2leg([1, 0, -2, 0, 1])
    along = [turn] + [legendre.legmul(bubble, np.eye(n_along)[i]) for i in range(n_along)]
    across = [np.eye(2 * n_across)[2 * j] for j in range(n_across)]

    def integrals(series, points, weights, extent):
        """Those of products of derivatives: [m][n] of the m-th of one function and the n-th of another."""
        values = [np.array([legendre.legval(points, legendre.legder(c, m)) for c in series]) * (2 / extent) ** m for m in range(3)]
        return [[0.5 * extent * (a * weights) @ b.T for b in values] for a in values]

    x, y = integrals(along, s, s_weight, length), integrals(across, t, t_weight, width)
    bending = np.kron(x[2][2], y[0][0]) + np.kron(x[0][0], y[2][2]) + nu * (np.kron(x[2][0], y[0][2]) + np.kron(x[0][2], y[2][0]))
    K = bending + 2 * (1 - nu) * np.kron(x[1][1], y[1][1])  # over the plate's rigidity
    free = np.arange(n_across, len(K))  # the cubic goes with no shape across
    moment = K[0, 0] - K[0, free] @ np.linalg.solve(K[np.ix_(free, free)], K[free, 0])
    return moment / (4 * (1 - nu**2) * width / length)


if __name__ == "__main__":
    print(f"{stiffness_ratio(100, 40, 0.3):.4f} times the beam; {1 / (1 - 0.3**2):.4f} in plane strain")
