"""Where the tip of a reduced blade is."""

import numpy as np

from bladerub.blade.model import ReducedBlade


def tip_radius(blade: ReducedBlade) -> float:
    """Return the mean distance of the interface nodes from the axis of rotation at rest, m.

    It is the radius at which the casing is drawn. In contact every node has its own.
    """
    return float(np.hypot(blade.node_position[:, 1], blade.node_position[:, 2]).mean())
