"""How the tip turns towards the casing as the blade vibrates."""

import numpy as np

from bladerub.blade.mesh import BladeMesh

REACH = 0.6
"""Distance to which nodes of the tip count, in distances of interface nodes: over the whole thickness."""


def tip_slope(
    mesh: BladeMesh, recovery: np.ndarray, radial: np.ndarray, tangential: np.ndarray
) -> np.ndarray | None:
    """Circumferential slope (8, n) of the tip at each interface node, per unit of each coordinate.

    A plane is fitted to the radial displacement of the tip's nodes around, within `REACH`. The slope is that
    of the plane along the casing, positive where the side ahead in the rotation rises. None if some interface
    node has too few neighbours on the tip for a plane. `recovery` (n, n_nodes, 3) is the displacement of the
    nodes per unit of each coordinate; `radial` and `tangential` (8, 3) are the directions at the interface.
    """
    points = mesh.mesh.points
    nodes = points[mesh.interface]
    reach = REACH * np.linalg.norm(np.diff(nodes, axis=0), axis=1).mean()
    slopes = []
    for node, outward, along in zip(nodes, radial, tangential, strict=True):
        offset = points[mesh.tip] - node
        neighbours = np.linalg.norm(offset, axis=1) <= reach
        offset = offset[neighbours]
        plane = np.stack([np.ones(len(offset)), offset @ along, offset @ np.cross(outward, along)], axis=1)
        if np.linalg.matrix_rank(plane, tol=1e-3 * reach) < 3:
            return None
        displacement = recovery[:, mesh.tip[neighbours]] @ outward
        slopes.append(np.linalg.lstsq(plane, displacement.T)[0][1])
    return np.array(slopes)
