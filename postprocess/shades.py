# SPDX-License-Identifier: GPL-3.0-only
"""Colours of stress, and how much displacements are magnified, in pictures of fields."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from style import plt

COLOUR_MAP = "viridis"
RIGID = "0.85"


def rounded(value):
    """Down to 1, 2 or 5 times a power of ten, at least 1."""
    if not np.isfinite(value) or value <= 1:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return power * max(step for step in (1, 2, 5) if step <= value / power * (1 + 1e-9))


def largest_size(points):
    return np.linalg.norm(points, axis=-1).max() if len(points) else 0.0


def make_norm(shown, parts=()):
    """Up to the stress that a thousandth of the nodes exceeds; logarithmic where the parts' own peaks lie far apart."""
    values = np.concatenate(shown) if shown else np.empty(0)
    top = np.quantile(values, 0.999) if len(values) else 0.0
    if not top > 0:
        return Normalize(0, 1)
    peaks = [np.quantile(part, 0.99) for part in parts]
    if peaks and min(peaks) < 0.03 * max(peaks):
        return LogNorm(1e-3 * top, top, clip=True)
    return Normalize(0, top, clip=True)


def make_mappable(norm):
    return plt.cm.ScalarMappable(norm, COLOUR_MAP)


def is_logarithmic(mappable):
    return isinstance(mappable.norm, LogNorm)
