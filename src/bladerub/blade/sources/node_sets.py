"""Clamped nodes and tip nodes of a mesh: by the name of a set, or by the direction of its surface."""

from collections.abc import Mapping
from difflib import get_close_matches

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from bladerub.blade.surface import normals

_FACING = np.cos(np.pi / 4)


def named(node_sets: Mapping[str, np.ndarray], name: str) -> np.ndarray:
    """Nodes of the set `name`, in capital or small letters unless another set differs in them only.

    Raises a ValueError if there is no such set, or no node in it.
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
    """Nodes of the part of the surface that is farthest from the engine axis and faces `outwards`: the tip.

    If not `outwards`, the part nearest to the axis that faces inwards: the root. Its normals are within 45
    degrees of the radial direction, and its `faces` are connected: it may be a cylinder, a cone or a plane,
    but ends at its edges. Raises a ValueError if there is none.
    """
    sign = 1 if outwards else -1
    middle = points[faces].mean(axis=1)
    radius = np.hypot(middle[:, 1], middle[:, 2])
    radial = normals(points[faces])[:, 1:] * middle[:, 1:]
    facing_so = faces[sign * radial.sum(axis=1) > _FACING * radius]
    if not len(facing_so):
        raise ValueError("no part of the surface faces along the radius; name a node set")
    rows = np.repeat(np.arange(len(facing_so)), facing_so.shape[1])
    touching = sparse.coo_array((np.ones(rows.size), (rows, facing_so.ravel())))
    _, part = connected_components(touching @ touching.T, directed=False)
    height = (sign * np.hypot(points[:, 1], points[:, 2]))[facing_so].max(axis=1)
    return np.unique(facing_so[part == part[np.argmax(height)]])
