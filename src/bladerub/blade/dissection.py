"""An order of the unknowns that keeps the factors of a large finite element matrix sparse."""

from __future__ import annotations

import numpy as np
import pymetis
from scipy import sparse


def nested_dissection(matrix: sparse.csc_array) -> np.ndarray:
    """Order (n,) in which to eliminate the unknowns of a symmetric `matrix` (n, n), by METIS.

    Unknowns that couple to the same ones, as those of one node do, are one vertex of the graph and stay
    together: METIS is then faster, and the factors have larger dense blocks.
    """
    pattern = sparse.csc_array((np.ones_like(matrix.indices), matrix.indices, matrix.indptr), matrix.shape)
    n = pattern.shape[0]
    mark = np.random.default_rng(0).integers(2**62, size=n)
    _, vertex = np.unique(pattern.T @ mark, return_inverse=True)  # whole numbers: the same sum in any order
    to_vertices = sparse.csr_array((np.ones(n, dtype=np.int64), (vertex, np.arange(n))))
    graph = sparse.csr_array(to_vertices @ pattern @ to_vertices.T)
    graph.setdiag(0)
    graph.eliminate_zeros()
    order, _ = pymetis.nested_dissection(pymetis.CSRAdjacency(graph.indptr, graph.indices))
    rank = np.empty(graph.shape[0], dtype=np.int64)
    rank[order] = np.arange(rank.size)
    return np.argsort(rank[vertex], kind="stable")
