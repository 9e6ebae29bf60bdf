"""Contact law of the tip with the rigid casing: nodes may touch the surface and not pass it, eq. (9)."""

from __future__ import annotations

import math

from numba import njit

from bladerub.contact.kernel.abradable import wrap
from bladerub.contact.kernel.vectors import (
    LANES,
    absolute,
    broadcast,
    largest_lane,
    load,
    maximum,
    smallest_lane,
)


@njit
def surface(stator, position):
    """Gap of each node to the smooth surface through the centres of the elements, m."""
    met = broadcast(0.0)
    for row in range(math.floor(smallest_lane(position)) - 1, math.floor(largest_lane(position)) + 2):
        weight = maximum(1.0 - absolute((row + 0.5) - position), 0.0)
        met = met + weight * load(stator.gap, wrap(row, stator.n_elements) * LANES)
    return met
