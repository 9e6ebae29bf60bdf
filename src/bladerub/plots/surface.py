"""Surface of a mesh of 20-node hexahedra and its view from one side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# Corners and mid-side nodes, in turn, around each face of a C3D20 hexahedron, seen from outside
_FACES = np.array(
    [
        [0, 11, 3, 10, 2, 9, 1, 8],
        [4, 12, 5, 13, 6, 14, 7, 15],
        [0, 8, 1, 17, 5, 12, 4, 16],
        [1, 9, 2, 18, 6, 13, 5, 17],
        [2, 10, 3, 19, 7, 14, 6, 18],
        [3, 11, 0, 16, 4, 15, 7, 19],
    ]
)


def boundary_faces(hexahedra: np.ndarray) -> np.ndarray:
    """Faces that belong to one element only.

    Parameters
    ----------
    hexahedra : (n_elements, 20) ndarray of int
        Nodes in the order of CalculiX's C3D20.

    Returns
    -------
    (n_faces, 8) ndarray of int
        Nodes around each face: corners and mid-side nodes in turn, a corner first, counter-clockwise seen
        from outside.
    """
    faces = hexahedra[:, _FACES].reshape(-1, 8)
    _, inverse, count = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)
    return faces[count[inverse.ravel()] == 1]


def normals(polygons: np.ndarray) -> np.ndarray:
    """Outward unit normals (n, 3) of faces (n, 8, 3) ordered as by `boundary_faces`."""
    normal = np.cross(polygons[:, 4] - polygons[:, 0], polygons[:, 6] - polygons[:, 2])
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


@dataclass(frozen=True)
class View:
    """Parallel projection with z upwards.

    Parameters
    ----------
    elevation, azimuth : float
        Direction from the object to the eye, degrees: over the x-y plane, and in it from x towards y.
    """

    elevation: float
    azimuth: float

    @property
    def towards_eye(self) -> np.ndarray:
        """Unit vector (3,) from the object to the eye."""
        elevation, azimuth = np.radians([self.elevation, self.azimuth])
        level = np.cos(elevation)
        return np.array([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)])

    def project(self, points: np.ndarray) -> np.ndarray:
        """Horizontal and vertical position (..., 2) of points (..., 3) in the picture, in the same unit."""
        right = np.cross([0, 0, 1], self.towards_eye)
        right /= np.linalg.norm(right)
        return points @ np.stack([right, np.cross(self.towards_eye, right)], axis=1)

    def front_faces(self, polygons: np.ndarray) -> np.ndarray:
        """List the faces among (n, 8, 3) that are turned to the eye, the farthest first."""
        facing = np.flatnonzero(normals(polygons) @ self.towards_eye > 1e-6)  # not those seen edge-on
        return facing[np.argsort((polygons[facing] @ self.towards_eye).mean(axis=1))]
