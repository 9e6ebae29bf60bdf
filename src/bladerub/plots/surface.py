"""The view of a surface from one side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bladerub.blade.surface import normals


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
        """List the faces among (n, 8 or 6, 3) that are turned to the eye, the farthest first."""
        facing = np.flatnonzero(normals(polygons) @ self.towards_eye > 1e-6)  # not those seen edge-on
        return facing[np.argsort((polygons[facing] @ self.towards_eye).mean(axis=1))]
