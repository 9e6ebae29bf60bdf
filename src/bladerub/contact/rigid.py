"""Contact law of one node with the rigid casing: it may touch the surface and not pass it, eq. (9)."""

from __future__ import annotations

import numpy as np
from numba import njit

from bladerub.contact.abradable import wrap


@njit(inline="always")
def surface(gap, j, position):
    """Gap of node `j` to the smooth surface through the centres of the elements, m."""
    n_elements = gap.shape[1]
    along = position - 0.5
    left = int(np.floor(along))
    weight = along - left
    return (1.0 - weight) * gap[j, wrap(left, n_elements)] + weight * gap[j, wrap(left + 1, n_elements)]


@njit(inline="always")
def push_of(gap, j, position, free_rise, own):
    """Lagrange multiplier of node `j`, which gives way by `own` per unit of it, N."""
    return max(0.0, free_rise - surface(gap, j, position)) / own
