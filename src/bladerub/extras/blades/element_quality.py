"""Checks of the nodes and elements of a mesh."""

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from bladerub.blade.mesh import SolidMesh
from bladerub.extras.blade_meshes import EDGES

FARTHEST = 1e9  # coordinate in any unit; beyond 1e154 squares overflow
_SAME_PLACE = 1e-7  # of the extent of the mesh
_FLAT = 1e-12  # Jacobian, over the cube of the size of the element
_MOST_OFF = 0.35  # of the edge; the middle of a quarter of a circle is 0.21 off its chord


def check_nodes(points: np.ndarray, cells: np.ndarray) -> None:
    """Check that the nodes of `cells` are apart, and mid-side ones in the middle; a ValueError names one."""
    used = np.unique(cells)
    outliers = used[~(abs(points[used]) <= FARTHEST).all(axis=1)]
    if outliers.size:
        place = ", ".join(f"{x:.4g}" for x in points[outliers[0]])
        raise ValueError(f"node {outliers[0] + 1}: is at {place}; must be finite numbers up to {FARTHEST:g}")
    extent = np.ptp(points[used], axis=0).max()
    twins = cKDTree(points[used]).query_pairs(_SAME_PLACE * extent, output_type="ndarray")
    if len(twins):
        first, second = np.sort(used[twins[0]]) + 1
        raise ValueError(f"nodes {first} and {second}: are in one place; merge them ({len(twins)} pairs)")
    ends = points[cells[:, EDGES[cells.shape[1]]]]
    sides = points[cells[:, -ends.shape[1] :]]
    off = np.linalg.norm(sides - ends.mean(axis=2), axis=-1)
    misplaced = np.argwhere(off > _MOST_OFF * np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=-1))
    if len(misplaced):
        element, edge = misplaced[0]
        number = cells.shape[1] - ends.shape[1] + edge + 1
        raise ValueError(
            f"element {element + 1}: its {number}th node is not in the middle of its edge; nodes must be in "
            "the order of CalculiX and VTK"
        )


def check_joined(cells: np.ndarray) -> None:
    """Check that `cells` are one body of elements whose nodes differ; a ValueError says if they are not."""
    ordered = np.sort(cells, axis=1)
    collapsed = np.flatnonzero((np.diff(ordered, axis=1) == 0).any(axis=1))
    if collapsed.size:
        raise ValueError(
            f"element {collapsed[0] + 1}: has a node twice ({collapsed.size} such of {len(cells)}); wedges "
            "written as hexahedra must be split into tetrahedra, and all others too"
        )
    sizes = np.unique(connected(cells), return_counts=True)[1]
    if sizes.size > 1:
        raise ValueError(
            f"has {sizes.size} bodies that share no nodes, of {', '.join(map(str, sizes[:4]))} elements; "
            "must be one blade: merge nodes where they touch, or leave the others out"
        )


def connected(cells: np.ndarray) -> np.ndarray:
    """Find the number (n,) of the body that each element or face of the nodes `cells` (n, m) is part of."""
    first = np.repeat(cells[:, 0], cells.shape[1])
    joined = sparse.coo_array((np.ones(first.size), (first, cells.ravel())), shape=2 * [cells.max() + 1])
    return connected_components(joined, directed=False)[1][cells[:, 0]]


def jacobians(mesh: SolidMesh) -> tuple[np.ndarray, float]:
    """Smallest over largest Jacobian of each element (n_elements,), or a ValueError, and the volume, m³."""
    points, weights = mesh.mass_quadrature()
    determinant = np.linalg.det(np.moveaxis(mesh.mapping().DF(points), (0, 1), (-2, -1)))
    if (determinant < 0).all():
        raise ValueError("all elements are left-handed; the mesh must not be mirrored, nor count backwards")
    flat = _FLAT * np.ptp(mesh.points[mesh.cells], axis=1).max(axis=1, keepdims=True) ** 3
    bad = np.flatnonzero((determinant <= flat).any(axis=1))
    if bad.size:
        raise ValueError(
            f"element {bad[0] + 1}: its Jacobian is zero or negative, it is flat or turned inside out "
            f"({bad.size} such of {len(determinant)})"
        )
    return determinant.min(axis=1) / determinant.max(axis=1), float(np.sum(determinant @ weights))
