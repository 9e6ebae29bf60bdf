"""Clamped nodes and tip nodes of a mesh: by the name of a set, or by which way its surface looks."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from bladerub.blade.surface import normals

_FACING = np.cos(np.pi / 4)


def named(node_sets: Mapping[str, np.ndarray], name: str) -> np.ndarray:
    """Nodes of the set `name`; capital or small letters are the same where no other set differs in them.

    Raises
    ------
    ValueError
        If there is no such set, or nothing in it; names those there are.
    """
    alike = [known for known in node_sets if known.lower() == name.lower()]
    found = name if name in node_sets else alike[0] if len(alike) == 1 else None
    if found is None:
        close = get_close_matches(name, node_sets, n=1)
        known = f"did you mean {close[0]}?" if close else f"there are {', '.join(node_sets) or 'none'}"
        raise ValueError(f'there is no node set "{name}"; {known}')
    if not node_sets[found].size:
        raise ValueError(f'the node set "{name}" has no nodes; a set of other sets is not read')
    return node_sets[found]


def facing(points: np.ndarray, faces: np.ndarray, outwards: bool) -> np.ndarray:
    """Nodes of that part of the surface that is farthest from (or nearest to) the engine axis and looks so.

    Faces count that look within 45 degrees of the radial direction, and of those the ones that hang
    together with the farthest (nearest): a tip or root may be a cylinder, a cone or a plane, but ends
    at its edges.

    Parameters
    ----------
    points : (n_nodes, 3) ndarray
        In the blade's frame.
    faces : (n_faces, 8 or 6) ndarray of int
        The surface (`bladerub.blade.surface.boundary_faces`).
    outwards : bool
        The tip if true, the root if not.

    Raises
    ------
    ValueError
        If there is none.
    """
    sign = 1 if outwards else -1
    middle = points[faces].mean(axis=1)
    radius = np.hypot(middle[:, 1], middle[:, 2])
    radial = normals(points[faces])[:, 1:] * middle[:, 1:]
    looking = faces[sign * radial.sum(axis=1) > _FACING * radius]
    if not len(looking):
        raise ValueError("no part of the surface looks along the radius; name a node set")
    rows = np.repeat(np.arange(len(looking)), looking.shape[1])
    touching = sparse.coo_array((np.ones(rows.size), (rows, looking.ravel())))
    _, part = connected_components(touching @ touching.T, directed=False)
    height = (sign * np.hypot(points[:, 1], points[:, 2]))[looking].max(axis=1)
    return np.unique(looking[part == part[np.argmax(height)]])
