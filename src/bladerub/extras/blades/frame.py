"""Units and axes by name, and the rotation from a file's axes to the blade's frame.

The blade's frame (`bladerub.blade.geometry`) has x along the engine axis, z along the blade, and a rotation
that takes z towards y: by the right-hand rule, about -x. A file whose axes are named is therefore only
turned, never mirrored, with x against its rotation vector. So x points downstream or upstream, depending on
the blade, and the leading edge may have the smaller or the larger x.
"""

from dataclasses import dataclass

import numpy as np

from bladerub.extras.cells import UNITS

FORCES = dict.fromkeys(("inch", "in", "feet", "ft"), 4.4482216152605)  # N, where a unit is not of N
LENGTHS = (0.01, 3.0)  # limits of the length of a blade, m, as those of ``blade.length`` of the config
AXES = ("x", "y", "z", "-x", "-y", "-z")


@dataclass(frozen=True)
class Frame:
    """Unit (of `UNITS`) and axes (of `AXES`) of a file; its engine axis passes through its origin.

    Raises ValueError if `downstream` is not along the engine axis or `radial` is not across it.
    """

    unit: str = "m"
    rotation: str = "-x"  # about which the blade turns by the right-hand rule
    downstream: str = "x"  # along which the air flows
    radial: str = "z"  # from root to tip

    def __post_init__(self):
        axis = self.rotation[-1]
        if self.downstream[-1] != axis:
            raise ValueError(
                f"downstream = {self.downstream}: must be along the axis of rotation, {axis} or -{axis}"
            )
        if self.radial[-1] == axis:
            raise ValueError(f"radial = {self.radial}: must not be the axis of rotation")

    @property
    def turn(self) -> np.ndarray:
        """Rotation matrix (3, 3) from the file's axes to the blade's."""
        x, z = -_vector(self.rotation), _vector(self.radial)
        return np.stack([x, np.cross(z, x), z])

    @property
    def downstream_x(self) -> int:
        """1 where the blade's x points downstream, -1 where it points upstream."""
        return -1 if self.downstream == self.rotation else 1

    def check_length(self, length: float) -> None:
        """Check that `length` (m) is one of a blade, or raise ValueError: the unit is wrong."""
        shortest, longest = LENGTHS
        if not shortest <= length <= longest:
            raise ValueError(
                f"with the unit {self.unit} the blade is {length:.4g} m long; must be from {shortest:g} to "
                f"{longest:g} m"
            )

    def metres(self, points: np.ndarray) -> np.ndarray:
        """Convert points (n, 3) of the file to the blade's frame, m."""
        return UNITS[self.unit] * points @ self.turn.T

    def cartesian(self, z: np.ndarray, r: np.ndarray, theta: np.ndarray) -> np.ndarray:
        """Turn cylindrical coordinates of the file (n,) into its Cartesian ones (n, 3).

        `z` counts along the engine axis in the positive direction of its letter, whichever sign `rotation`
        has; `theta` (rad) counts about that direction by the right-hand rule, from `radial` on. So the blade
        turns towards larger angles where `rotation` is x, y or z, to smaller ones where it is -x, -y or -z.
        """
        axis, radial = _vector(self.rotation[-1]), _vector(self.radial)
        around = np.cross(axis, radial)
        z, r, theta = z[:, None], r[:, None], theta[:, None]
        return z * axis + r * (np.cos(theta) * radial + np.sin(theta) * around)


def _vector(axis: str) -> np.ndarray:
    return (-1.0 if axis.startswith("-") else 1.0) * np.eye(3)["xyz".index(axis[-1])]
