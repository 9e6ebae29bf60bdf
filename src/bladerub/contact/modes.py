"""Modal coordinates of the reduced blade at one speed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg

from bladerub.blade.model import N_INTERFACE, ReducedBlade


class Modes(NamedTuple):
    """Mass-normalised modes seen from the blade tip.

    Parameters
    ----------
    omega : (n,) ndarray
        Natural angular frequencies, ascending, rad/s.
    tip : (16, n) ndarray
        Displacement of the tip per unit of each mode: radial at the 8 nodes, then tangential, kg^-1/2.
    """

    omega: np.ndarray
    tip: np.ndarray


def modes_at(blade: ReducedBlade, f_omega: float) -> Modes:
    """Diagonalise mass and stiffness, eq. (2), of the blade at the normalised speed `f_omega`.

    Raises
    ------
    ValueError
        If `f_omega` is outside the fitted range or the stiffness is not positive definite there.
    """
    squares, vectors = scipy.linalg.eigh(blade.stiffness(f_omega), blade.mass)
    if squares[0] <= 0:
        raise ValueError(f"f_omega = {f_omega:g}: the stiffness of the blade is not positive definite")
    interface = vectors[: 3 * N_INTERFACE].reshape(N_INTERFACE, 3, -1)
    radial = np.einsum("ja,jan->jn", blade.radial_direction, interface)
    tangential = np.einsum("ja,jan->jn", blade.tangential_direction, interface)
    return Modes(np.sqrt(squares), np.ascontiguousarray(np.vstack([radial, tangential])))
