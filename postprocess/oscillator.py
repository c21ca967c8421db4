# SPDX-License-Identifier: GPL-3.0-only
"""The orbit of params/stribeck-a.prm on a linear contact beside that of an oscillator integrated here."""

import math

import numpy as np

from style import MILLIMETRE, ONE_COLUMN, look, plt

# With these the scene is that oscillator.
CHANGES = {
    "Contact/Stiffness": 2000,
    "Contact/Exponent": 1,
    "Contact/Damping": 0.3,
    "Contact/Tangential stiffness": 1000,
    "Friction/Memory length": 0.05,
    "Time/Tolerance": 1e-3,
}
BEGIN, END = 1.4, 1.47  # two laps, after transients [s]


def make_rates():
    """Rates of the frame, the lever's turn, the layer's shear and mu, and whether the layer slips, over time and these."""
    R, e, l, k, J, length = 56.0, 45.6, 185.5, 7.40e4, 6.45, 210.0
    axis = e + 1 + 10
    lever = J / (length**2 / 3 + axis**2)
    m, stiffness = 2e-3 + lever, 100.0
    support = 2 * 0.02 * math.sqrt(stiffness * m)
    dashpot = 2 * 0.3 * math.sqrt(2000 * J) / math.sqrt(130.5**2 - 10.4**2)
    drag = 2e-3  # makes the slip's speed explicit [N s/mm]

    def rates(t, u, theta, u_rate, theta_rate, shear, mu):
        sine, cosine = math.sin(theta), math.cos(theta)
        a = l - (55 - 10 * (t - 1)) + u
        s, h = a * cosine, a * sine
        speed = -10 - u_rate
        P = max(0.0, 2000 * (R - e - h) + dashpot * (speed * sine - s * theta_rate))
        F = 1000 * shear
        creep = math.copysign(max(0.0, abs(F) - mu * P) / drag, F)
        force = P * sine + F * cosine - support * u_rate - stiffness * u
        moment = P * s + F * (R - h) - k * (theta - math.asin((R - e) / l))
        coupling = lever * (0.5 * length * sine + axis * cosine)
        determinant = m * J - coupling**2
        return (
            u_rate,
            theta_rate,
            (J * force - coupling * moment) / determinant,
            (m * moment - coupling * force) / determinant,
            speed * cosine + (h - R) * theta_rate - creep,
            -abs(creep) / 0.05 * (mu - 0.6 - 0.3 * math.exp(-abs(creep) / 30)),
        ), creep != 0

    return rates, math.asin((R - e) / (l - 55)) - 5e-5


def integrate(dt=1e-6):
    """Displacement and speed of the frame from BEGIN to END [mm, mm/s]. It slides back from x = 55 mm at t = 1 s."""
    rates, theta = make_rates()
    mu = 0.6 + 0.3 * math.exp(-1 / 3)
    y = (0.0, theta, 0.0, 0.0, -1.5e-2, mu)
    orbit = []
    for i in range(round((END - 1) / dt)):
        t = 1 + i * dt
        a, _ = rates(t, *y)
        b, _ = rates(t + dt / 2, *(p + dt / 2 * q for p, q in zip(y, a)))
        c, _ = rates(t + dt / 2, *(p + dt / 2 * q for p, q in zip(y, b)))
        d, _ = rates(t + dt, *(p + dt * q for p, q in zip(y, c)))
        y = tuple(p + dt / 6 * (q + 2 * r + 2 * s + o) for p, q, r, s, o in zip(y, a, b, c, d))
        if not rates(t + dt, *y)[1]:
            y = (*y[:5], 0.9)
        if t >= BEGIN:
            orbit.append((y[0], y[2]))
    return np.array(orbit).T


def orbits(result):
    """Phase portraits of the frame, of a run of the scene and of the oscillator."""
    time, u = (result.table[name] for name in ("time", "support_displacement"))
    rows = (time >= BEGIN) & (time <= END)
    figure, axes = plt.subplots(figsize=(ONE_COLUMN, 70 * MILLIMETRE))
    axes.plot(*integrate(), label="own oscillator", **look(0))
    axes.plot(u[rows], np.gradient(u, time)[rows], label=result.name, **look(1))
    axes.set_xlabel("displacement of the frame [mm]")
    axes.set_ylabel("speed of the frame [mm/s]")
    axes.legend(loc="center")
    return figure
