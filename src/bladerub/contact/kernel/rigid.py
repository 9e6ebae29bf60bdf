"""The rigid casing: nodes may touch its surface and not pass it, eq. (9)."""

import math

from numba import njit

from bladerub.contact.kernel.elements import wrap
from bladerub.numerics.memory import load
from bladerub.numerics.vectors import LANES, absolute, broadcast, largest_lane, maximum, smallest_lane


@njit
def surface(stator, position):
    """Return the initial gap of each node to the smooth surface through the centres of the elements, m."""
    found = broadcast(0.0)
    for row in range(math.floor(smallest_lane(position)) - 1, math.floor(largest_lane(position)) + 2):
        weight = maximum(1.0 - absolute((row + 0.5) - position), 0.0)
        found = found + weight * load(stator.initial_gap, wrap(row, stator.n_elements) * LANES)
    return found
