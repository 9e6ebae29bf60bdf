"""Modal coordinates of the reduced blade at one speed."""

from typing import NamedTuple

import numpy as np
import scipy.linalg

from bladerub.blade.model import N_INTERFACE, ReducedBlade


class Modes(NamedTuple):
    """Mass-normalised modes seen from the blade tip."""

    omega: np.ndarray  # (n,): Natural angular frequencies, ascending, rad/s
    # (16, n): Displacement of the tip per unit of each mode: radial at the 8 nodes, then tangential,
    # kg^-1/2
    tip: np.ndarray


def modes_at(blade: ReducedBlade, f_omega: float) -> Modes:
    """Find the modes of the blade at the normalised speed `f_omega`, as `mode_shapes_at`."""
    omega, shapes = mode_shapes_at(blade, f_omega)
    return Modes(omega, at_tip(blade, shapes))


def mode_shapes_at(blade: ReducedBlade, f_omega: float) -> tuple[np.ndarray, np.ndarray]:
    """Diagonalise mass and stiffness, eq. (2), of the blade at the normalised speed `f_omega`.

    Returns the natural angular frequencies (n,), ascending, rad/s, and the reduced coordinates per unit of
    each mode (n, n), mass-normalised, kg^-1/2. Raises `ValueError` if `f_omega` is outside the fitted range
    or the stiffness is not positive definite there.
    """
    squares, vectors = scipy.linalg.eigh(blade.stiffness(f_omega), blade.mass)
    if squares[0] <= 0:
        raise ValueError(f"f_omega = {f_omega:g}: the stiffness of the blade is not positive definite")
    return np.sqrt(squares), vectors


def at_tip(blade: ReducedBlade, coordinates: np.ndarray) -> np.ndarray:
    """Project reduced coordinates (n, k) on the tip (16, k): radial at the 8 nodes, then tangential."""
    interface = coordinates[: 3 * N_INTERFACE].reshape(N_INTERFACE, 3, -1)
    radial = np.einsum("ja,jan->jn", blade.radial_direction, interface)
    tangential = np.einsum("ja,jan->jn", blade.tangential_direction, interface)
    return np.ascontiguousarray(np.vstack([radial, tangential]))
