"""Which coordinates of the nodes can move, and where each is in vectors of those alone."""

from __future__ import annotations

import numpy as np


class FreeCoordinates:
    """The coordinates of nodes that are not clamped; full vectors have them at ``3 * node + axis``.

    Parameters
    ----------
    n_nodes : int
        Of all nodes, those clamped among them.
    clamped : array_like of int
        Nodes that cannot move.

    Attributes
    ----------
    free : (n,) ndarray of int
        Position of each free coordinate in the full vector.
    axis : (n,) ndarray of int
        0, 1, 2 for x, y, z.
    """

    def __init__(self, n_nodes: int, clamped=()):
        self.n_nodes = n_nodes
        is_free = np.ones((n_nodes, 3), dtype=bool)
        is_free[np.asarray(clamped, dtype=int)] = False
        self.free = np.flatnonzero(is_free)
        self.axis = self.free % 3

    def full(self, u: np.ndarray) -> np.ndarray:
        """Displacement (n_nodes, 3) of all nodes for the free coordinates `u`, m."""
        vector = np.zeros(3 * self.n_nodes)
        vector[self.free] = u
        return vector.reshape(-1, 3)

    def coordinates(self, nodes: np.ndarray) -> np.ndarray:
        """Places in the free vector of the x, y, z of `nodes`, node by node."""
        return np.searchsorted(self.free, (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel())
