"""Profiles in the plane, their camber lines, and the interface nodes on that of the tip of a blade."""

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

_STATIONS = np.linspace(0.06, 0.94, 45)  # of the chord; further out the normal may meet the edge itself
_DEGREE = 5
_ROUNDS = 8


def camber_line(outline: np.ndarray) -> np.ndarray:
    """Draw the line (47, 2) midway between the two sides, measured across itself, from one end to the other.

    `outline` (n, 2, 2) holds the ends of the straight pieces of the closed profile, in any order. The line is
    continued straight to the two ends. Raises a ValueError if the outline is not such a profile.
    """
    corners = outline[:, 0]
    apart = cdist(corners, corners)
    first, last = np.unravel_index(np.argmax(apart), apart.shape)
    chord = apart[first, last]
    along = (corners[last] - corners[first]) / chord
    to_chord = np.stack([along, [-along[1], along[0]]])
    pieces = (outline - corners[first]) @ to_chord.T / chord
    curve = np.polynomial.Polynomial([0.0])
    for _ in range(_ROUNDS):
        on_line = np.stack([_STATIONS, curve(_STATIONS)], axis=1)
        slope = curve.deriv()(_STATIONS)
        across = np.stack([-slope, np.ones_like(slope)], axis=1)
        middle = np.array([_middle(pieces, *station) for station in zip(on_line, across, strict=True)])
        curve = np.polynomial.Polynomial.fit(middle[:, 0], middle[:, 1], _DEGREE)
    inner = np.stack([_STATIONS, curve(_STATIONS)], axis=1)
    slope = curve.deriv()(_STATIONS)
    ends = []
    for end, sign in ((0, -1), (-1, 1)):
        outwards = sign * np.array([1.0, slope[end]])
        distances, _ = crossings(pieces, inner[end], outwards)
        if not (distances > 0).any():
            raise ValueError("no closed profile")
        ends.append(inner[end] + distances[distances > 0].min() * outwards)
    line = np.vstack([ends[0], inner, ends[1]])
    return corners[first] + chord * line @ to_chord


def _middle(pieces: np.ndarray, point: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Point midway between the two sides on the line through `point` along `direction`."""
    distances = np.unique(crossings(pieces, point, direction)[0])
    if distances.size < 2:
        raise ValueError("no profile with two sides")
    nearest = distances[np.argsort(np.abs(distances))[:2]]
    return point + nearest.mean() * direction


def arc_length(points: np.ndarray) -> np.ndarray:
    """Length (n,) of the polygon through `points` (n, 2) from the first to each of them."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def crossings(pieces: np.ndarray, point: np.ndarray, direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find where the line through `point` along `direction` meets straight pieces with the ends (n, 2, 2).

    Returns the distance (n_met,) from the point, in lengths of `direction`, and the number (n_met,) of the
    piece, from 0, plus the share of it before the crossing.
    """
    ends = pieces - point
    side = ends @ np.array([-direction[1], direction[0]])
    met = (side[:, 0] < 0) != (side[:, 1] < 0)  # once, where it goes through an end that two pieces share
    start, stop = side[met].T
    share = start / (start - stop)
    places = (1 - share)[:, None] * ends[met, 0] + share[:, None] * ends[met, 1]
    return places @ direction / (direction @ direction), np.flatnonzero(met) + share


def cone(points: np.ndarray, degrees: float | None, downstream_x: int) -> float:
    """Half angle (rad) of the tip's cone, positive where it widens with x, fitted to `points` (n, 3) there.

    If it is given, in `degrees`, that is positive where the cone widens downstream.
    """
    if degrees is not None:
        return downstream_x * float(np.deg2rad(degrees))
    radius = np.hypot(points[:, 1], points[:, 2])
    x = points[:, 0] - points[:, 0].mean()
    return float(np.arctan2(x @ (radius - radius.mean()), x @ x))


def interface(points: np.ndarray, faces: np.ndarray, downstream_x: int, n_nodes: int) -> tuple:
    """Choose `n_nodes` interface nodes, leading to trailing edge, evenly along the camber line of the tip.

    The tip, the `faces` of the mesh there, is unrolled about the engine axis. Also returns the length of the
    camber line and the largest distance of a node from its place on it, m. A ValueError says if the tip is no
    profile with two sides and so many nodes, or too coarse.
    """
    nodes = np.unique(faces)
    if nodes.size < n_nodes:
        raise ValueError(f"the tip has {nodes.size} nodes; must have {n_nodes} or more")
    y, z = points[nodes, 1:].mean(axis=0)
    phi = np.arctan2(points[:, 1] * z - points[:, 2] * y, points[:, 2] * z + points[:, 1] * y)
    flat = np.stack([points[:, 0], np.hypot(points[:, 1], points[:, 2]) * phi], axis=1)
    try:
        line = camber_line(flat[_outline(faces)])
    except ValueError as error:
        raise ValueError(f"the tip is {error}; name its node set") from error
    if downstream_x * (line[-1, 0] - line[0, 0]) < 0:
        line = line[::-1]
    arc = arc_length(line)
    evenly = np.linspace(0, arc[-1], n_nodes)
    targets = np.stack([np.interp(evenly, arc, line[:, axis]) for axis in range(2)], axis=1)
    distance = cdist(targets, flat[nodes])
    indices = linear_sum_assignment(distance**2)[1]
    offset = distance[np.arange(n_nodes), indices].max()
    if offset > arc[-1] / (2 * (n_nodes - 1)):
        fault = f"an interface node would be {offset:.3g} m off its place on a camber line of {arc[-1]:.3g} m"
        raise ValueError(f"the tip is too coarse: {fault}")
    return nodes[indices], float(arc[-1]), float(offset)


def _outline(faces: np.ndarray) -> np.ndarray:
    """List the ends (n, 2) of the pieces of edges that belong to one of `faces` only."""
    pieces = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
    _, first, count = np.unique(np.sort(pieces, axis=1), axis=0, return_index=True, return_counts=True)
    return pieces[first[count == 1]]
