"""What ties matrices to the places of their nodes: the motions of a rigid body.

A permutation of coordinates changes no frequency. But the mass of a node is alike in all directions, and a
translation or a rotation of the rigid body leaves no force at rest, except at nodes next to clamped ones.
Translations show whether the coordinates are x, y, z node by node, rotations whether the nodes are where
``nodes.csv`` has them: `points` (n, 3) for the nodes of a matrix (3n, 3n), in `rows` (n,), from 1.
"""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array
from scipy.sparse.linalg import norm, spsolve
from scipy.spatial import cKDTree

_UNEQUAL = 1e-3  # mass of a node in two directions, over the sum of its entries
_HELD = 1e-4  # force after a translation, over the sum of the entries; clamped neighbours leave 3e-3 and more
_TURNED = 1e-2  # force after a rotation; two neighbours exchanged leave 0.03, coordinates in 1e-5 m 3e-4
_NEAR = 4.0  # distance from a held to a clamped node, over that to the farthest node that it is joined to
_APART = 0.02  # of that distance, a node from its place
_CHANGED = 0.2  # stiffness of a node by rotation; a blade changes by hundredths
_MOST_BAD = 0.75  # of the nodes with forces; beyond, too few are right to say which are wrong
_MOST_SOLVED = 10_000  # nodes
_NAMED = 4  # rows in a message


def check_joined(mass: csc_array, stiffness: csc_array) -> None:
    """Raise ValueError if coordinates are joined to no other, unless a penalty makes them stiffest of all."""
    joined = csc_array(abs(stiffness) - diags_array(abs(stiffness).diagonal())).sum(axis=0) > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        square = stiffness.diagonal() / mass.diagonal()  # of the frequency of each coordinate alone
    is_penalty = (mass.diagonal() > 0) & (square > square[joined].max(initial=0.0))
    isolated = np.flatnonzero(~joined & ~is_penalty)
    if isolated.size:
        first = f"row {isolated[0] + 1} is the first, without those of clamped nodes"
        doubt = f"{isolated.size} coordinates are joined to no other ({first}): clamped ones with a number on"
        cure = "Mark their nodes in the column clamped of nodes.csv, or leave their rows out"
        raise ValueError(f"{doubt} the diagonal? {cure}")


def check_mass(mass: csc_array, rows: np.ndarray) -> None:
    """Raise ValueError if the mass of nodes differs by direction, or acts between directions."""
    _check_coordinates(mass, _unequal, rows, "differs by direction, or acts between directions,")


def check_same_nodes(mass: csc_array, stiffness: csc_array, rows: np.ndarray) -> None:
    """Raise ValueError if the mass joins nodes that the stiffness does not: it has another order."""
    pairs, joined = _pairs(mass), _pairs(stiffness)
    outside = (pairs - pairs * joined.astype(bool)).tocoo()
    if norm(outside) > _UNEQUAL * norm(pairs):
        worst = int(np.argmax(outside.data))
        both = sorted((rows[outside.row[worst]], rows[outside.col[worst]]))
        fault = f"joins the nodes in rows {both[0]} and {both[1]} of nodes.csv, which stiffness_rest does not"
        raise ValueError(f"{fault}; both must have the order of nodes.csv")


def check_change(stiffness: csc_array, stiffness_rest: csc_array, rows: np.ndarray) -> None:
    """Raise ValueError if a stiffness at speed is far from that at rest at nodes: other order or unit."""
    change, size = (norm(_pairs(matrix), axis=1) for matrix in (stiffness - stiffness_rest, stiffness_rest))
    bad = change > _CHANGED * size
    if bad.any():
        fault = f"differs from stiffness_rest by up to {(change / size).max():.0%} at {_named(rows[bad])}"
        rule = "both must have the same order and units, as rotation changes hundredths"
        raise ValueError(f"{fault}; {rule}")


def check_stiffness(
    stiffness: csc_array, points: np.ndarray, rows: np.ndarray, clamped: np.ndarray, interface: np.ndarray
) -> None:
    """Raise ValueError if a translation leaves forces at nodes away from the clamped ones.

    `clamped` (m, 3) are the places of clamped nodes; the nodes `interface` are away from any, at the tip.
    Nodes that are joined to all others, as in a condensed matrix, tell nothing.
    """

    def away(matrix: csc_array) -> np.ndarray:
        pairs = _pairs(matrix)
        held = _held(matrix, pairs) & (np.diff(pairs.indptr) < len(points))
        is_away = np.isin(np.arange(len(points)), interface)
        if len(clamped):
            is_away |= cKDTree(clamped).query(points)[0] > _NEAR * _reach(pairs, points)
        return held & is_away

    fault = "a translation of the rigid blade leaves forces away from clamped nodes,"
    _check_coordinates(stiffness, away, rows, fault)


def check_places(stiffness: csc_array, points: np.ndarray, rows: np.ndarray) -> None:
    """Raise ValueError if a rotation leaves forces where a translation leaves none: nodes are elsewhere."""
    pairs = _pairs(stiffness)
    free = ~_held(stiffness, pairs)
    bad = np.flatnonzero(free & _turned(stiffness, pairs, points))
    if bad.size:
        order = (
            "must have the order of the matrices: has the solver renumbered the nodes, are axes exchanged?"
        )
        cause = _misplaced(stiffness, pairs, points, free, bad, rows) or order
        raise ValueError(
            f"{cause} (a rotation of the rigid blade leaves forces in stiffness_rest at {_named(rows[bad])}, "
            f"of {np.count_nonzero(free)} that touch no clamped node)"
        )


def _misplaced(stiffness, pairs, points, free, bad, rows) -> str | None:
    """Name the rows of the nodes `bad` that the rigid motion of all others puts elsewhere."""
    if bad.size > min(_MOST_BAD * np.count_nonzero(free), _MOST_SOLVED):
        return None
    coordinates = (3 * bad[:, None] + np.arange(3)).ravel()
    motion = _rotations(points)
    motion[coordinates] = 0
    block = csc_array(stiffness[coordinates][:, coordinates])
    x_turn, y_turn, z_turn = -spsolve(block, (stiffness @ motion)[coordinates]).T.reshape(3, -1, 3)
    moved = points.copy()
    moved[bad] = points.mean(axis=0) + np.stack([-y_turn[:, 2], -z_turn[:, 0], -x_turn[:, 1]], axis=1)
    if (free & _turned(stiffness, pairs, moved)).any():
        return None
    tolerance = _APART * _reach(pairs, points)
    wrong = bad[np.linalg.norm(moved[bad] - points[bad], axis=1) > tolerance[bad]]
    cure = "exchanged" if wrong.size == 2 else "in another order"
    if (cKDTree(points[wrong]).query(moved[wrong])[0] > tolerance[wrong]).any():
        cure = "in another place"
    return f"{_listed(rows[wrong])}: must be {cure}"


def _pairs(matrix: csc_array) -> csr_array:
    """Norms (n, n) of the 3 x 3 blocks of pairs of nodes."""
    entries = matrix.tocoo()
    n = matrix.shape[0] // 3
    squares = csr_array((entries.data**2, (entries.row // 3, entries.col // 3)), shape=(n, n))
    squares.eliminate_zeros()
    return squares.sqrt()


def _reach(pairs: csr_array, points: np.ndarray) -> np.ndarray:
    """Distance (n,) from each node to the farthest that it is joined to."""
    return _lengths(pairs, points).max(axis=1).toarray().ravel()


def _lengths(pairs: csr_array, points: np.ndarray) -> csr_array:
    rows = np.repeat(np.arange(len(points)), np.diff(pairs.indptr))
    lengths = np.linalg.norm(points[rows] - points[pairs.indices], axis=1)
    return csr_array((lengths, pairs.indices, pairs.indptr), shape=pairs.shape)


def _rotations(points: np.ndarray) -> np.ndarray:
    """Displacements (3n, 3) by unit rotations about three axes through the middle of `points`."""
    arms = points - points.mean(axis=0)
    return np.stack([np.cross(axis, arms).ravel() for axis in np.eye(3)], axis=1)


def _forces(matrix: csc_array, motion: np.ndarray) -> np.ndarray:
    """Norm (n,) of the forces at each node after the motions (3n, 3)."""
    return np.linalg.norm((matrix @ motion).reshape(-1, 9), axis=1)


def _held(stiffness: csc_array, pairs: csr_array) -> np.ndarray:
    """Whether a translation leaves forces at each node (n,)."""
    return _forces(stiffness, np.tile(np.eye(3), (pairs.shape[0], 1))) > _HELD * pairs.sum(axis=1)


def _turned(stiffness: csc_array, pairs: csr_array, points: np.ndarray) -> np.ndarray:
    """Whether a rotation leaves forces at each node (n,)."""
    unbalanced = (pairs * _lengths(pairs, points)).sum(axis=1)  # the forces if nothing cancelled
    return (unbalanced > 0) & (_forces(stiffness, _rotations(points)) > _TURNED * unbalanced)


def _unequal(mass: csc_array) -> np.ndarray:
    """Whether the mass of each node (n,) is not that of a body; of nodes joined to all others it may be."""
    pairs = _pairs(mass)
    sums = (mass @ np.tile(np.eye(3), (pairs.shape[0], 1))).reshape(-1, 3, 3)
    mean = np.trace(sums, axis1=1, axis2=2)[:, None, None] / 3
    off = np.linalg.norm((sums - mean * np.eye(3)).reshape(-1, 9), axis=1)
    return (off > _UNEQUAL * pairs.sum(axis=1)) & (np.diff(pairs.indptr) < max(len(off), 2))


def _check_coordinates(matrix: csc_array, is_bad: Callable, rows: np.ndarray, fault: str) -> None:
    """Raise ValueError of the `fault` of bad nodes; it says whether all x come first, then all y, all z."""
    bad = is_bad(matrix)
    if bad.any():
        order = np.arange(matrix.shape[0]).reshape(3, -1).T.ravel()  # from all x, then all y, then all z
        is_by_direction = not is_bad(matrix[order][:, order]).any()
        has = "it has all x, then all y, then all z" if is_by_direction else "are coordinates exchanged?"
        rule = f"must have x, y, z node by node, in the axes of nodes.csv: {has}"
        raise ValueError(f"{fault} at {_named(rows[bad])}; {rule}")


def _named(rows: np.ndarray) -> str:
    """Write how many nodes there are, and the first `rows` of them."""
    return f"{rows.size} node{'s' if rows.size > 1 else ''} ({_listed(rows)})"


def _listed(rows: np.ndarray) -> str:
    ellipsis = ", …" if rows.size > _NAMED else ""
    return f"row{'s' if rows.size > 1 else ''} {', '.join(map(str, rows[:_NAMED]))}{ellipsis}"
