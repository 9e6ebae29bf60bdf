"""Profiles in the plane: the camber line between their two sides, and where lines meet them."""

import numpy as np
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
