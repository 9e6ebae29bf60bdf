"""Which coordinates of the nodes can move, and where each is in vectors of those alone."""

import numpy as np


class FreeCoordinates:
    """The coordinates of `n_nodes` nodes that are not `clamped`; full vectors have all, node by node."""

    def __init__(self, n_nodes: int, clamped=()):
        self.n_nodes = n_nodes
        is_free = np.ones((n_nodes, 3), dtype=bool)
        is_free[np.asarray(clamped, dtype=int)] = False
        self.free = np.flatnonzero(is_free)  # (n,), place of each free coordinate in the full vector
        self.axis = self.free % 3  # (n,), 0, 1, 2 for x, y, z

    def full(self, u: np.ndarray) -> np.ndarray:
        """Displacement (n_nodes, 3) of all nodes for the free coordinates `u`, m."""
        vector = np.zeros(3 * self.n_nodes)
        vector[self.free] = u
        return vector.reshape(-1, 3)

    def coordinates(self, nodes: np.ndarray) -> np.ndarray:
        """Places in the free vector of the x, y, z of `nodes`, node by node."""
        return np.searchsorted(self.free, (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel())
