#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-only
"""Rigid parabola sliding on an elastic layer bonded to a rigid base, plane strain: the reference behind the fits in
tests/deviation.md (nu = 0) and behind tests/verification/incompressible_layer.cc (nu up to 0.5).

The layer's surface compliance is exact, mode by mode: u = U(z) exp(ikx), w = W(z) exp(ikx) obey a linear system of four ordinary
equations through the thickness. The contact, w = delta - x^2/2R under p >= 0 with the traction mu p, is solved on a grid by an
active set. Everything is without dimension: lengths over the thickness t, stresses over E; force per width P.

    /usr/bin/python3 tests/verification/bonded_layer.py     # prints solution and fits
"""
import numpy as np

PERIOD = 24.0  # of the grid, in thicknesses: the layer feels a load for about two
N_GRID = 8192


def exponential(matrix: np.ndarray) -> np.ndarray:
    """exp(matrix) by scaling, Taylor series and squaring."""
    squarings = max(0, int(np.ceil(np.log2(np.abs(matrix).sum(axis=1).max()))) + 4)
    scaled = matrix / 2.0**squarings
    result = np.eye(len(matrix), dtype=complex)
    term = result
    for k in range(1, 14):
        term = term @ scaled / k
        result = result + term
    for _ in range(squarings):
        result = result @ result
    return result


def compliance(k: float, nu: float) -> tuple[float, complex]:
    """Deflection by pressure and by traction of wave number k."""
    if k == 0.0:
        return (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu), 0.0
    if k > 12.0:  # a half-space, to 1e-7
        return 2.0 * (1.0 - nu * nu) / k, -1j * (1.0 + nu) * (1.0 - 2.0 * nu) / k
    shear = 0.5 / (1.0 + nu)
    ratio = nu / (1.0 - nu)  # lambda / (lambda + 2 mu)
    through = np.zeros((4, 4), complex)  # of (u, w, tau, sigma)
    through[0, 1], through[0, 2] = -1j * k, 1.0 / shear
    through[1, 0], through[1, 3] = -1j * k * ratio, 0.5 * (1.0 - ratio) / shear
    through[2, 0], through[2, 3] = k * k / (1.0 - nu * nu), -1j * k * ratio
    through[3, 2] = -1j * k
    transfer = exponential(through)
    surface = np.linalg.solve(transfer[:2, :2], transfer[:2, 2:])
    return surface[1, 1].real, surface[1, 0]


def kernels(nu: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Deflection at each distance under a unit pressure and traction on one grid cell."""
    half = [compliance(2.0 * np.pi * i / PERIOD, nu) for i in range(N_GRID // 2 + 1)]
    normal = np.array([c[0] for c in half], complex)
    tangential = np.array([c[1] for c in half], complex)
    tangential[-1] = 0.0
    return (np.fft.ifft(np.concatenate([normal, normal[-2:0:-1]])).real,
            np.fft.ifft(np.concatenate([tangential, np.conj(tangential[-2:0:-1])])).real)


def solve(force: float, mu: float, normal: np.ndarray, tangential: np.ndarray) -> tuple[float, float, float, float]:
    """Half-width a, indentation delta R, offset of the centre of pressure and largest pressure p R for P R = force."""
    dx = PERIOD / N_GRID
    reach = int(min(4.0, 1.5 * (1.5 * force) ** (1 / 3) + 0.3) / dx)
    index = np.arange(-reach, reach + 1)
    x = index * dx
    distance = (index[:, None] - index[None, :]) % N_GRID
    matrix = normal[distance] + mu * tangential[distance]
    active = np.abs(x) < (1.5 * force) ** (1 / 3)
    pressure = np.zeros(len(x))
    for _ in range(100):
        inside = np.flatnonzero(active)
        system = np.zeros((len(inside) + 1, len(inside) + 1))
        system[:-1, :-1] = matrix[np.ix_(inside, inside)]
        system[:-1, -1] = -1.0
        system[-1, :-1] = dx
        solution = np.linalg.solve(system, np.append(-x[inside] ** 2 / 2.0, force))
        pressure = np.zeros(len(x))
        pressure[inside] = solution[:-1]
        gap = matrix @ pressure - (solution[-1] - x**2 / 2.0)
        updated = (active & (pressure >= 0.0)) | (~active & (gap < 0.0))
        if np.array_equal(updated, active):
            break
        active = updated
    return 0.5 * (np.count_nonzero(active) * dx), solution[-1], (pressure * x).sum() * dx / force, pressure.max()


def main() -> None:
    normal, tangential = kernels()
    mu = 0.73
    print(f"mu = {mu}, nu = 0; a half-width, t thickness")
    print("P R/(E t^2)    a/t    delta R/t^2  fit     offset/(mu t)  fit     P R/(E t^2) fit")
    for force in (0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.5, 4.0):
        z, indentation, offset, _ = solve(force, mu, normal, tangential)
        print(f"{force:9.2f}  {z:9.4f}  {indentation:9.4f} {z * z / 2 + 0.18 * z:9.4f}"
              f"  {abs(offset) / mu:10.4f} {0.5 * z / (z + 1.3):9.4f}  {2 * z**3 / 3 + 0.36 * z * z + 0.05 * z:10.4f}")


if __name__ == "__main__":
    main()
