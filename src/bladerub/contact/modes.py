"""Modal coordinates of the reduced blade at one speed, and the central differences in them."""

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


class Recurrence(NamedTuple):
    """Two-step recurrence of each mode, ``q⁺ = now q − before q⁻ + responseᵀ F``.

    Parameters
    ----------
    now, before : (n,) ndarray
        Coefficients of the present and of the previous modal coordinate.
    response : (16, n) ndarray
        Modal coordinates per unit of tip force, in the step where it acts, m kg^1/2/N.
    loss : (n,) ndarray
        Energy lost to damping in the step per ``(q⁺ − q⁻)²``, 1/s².
    tip : (16, n) ndarray
        As in `Modes`.
    compliance : (16, 16) ndarray
        Displacement of the tip in the same step per unit of tip force, m/N.
    """

    now: np.ndarray
    before: np.ndarray
    response: np.ndarray
    loss: np.ndarray
    tip: np.ndarray
    compliance: np.ndarray


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


def central_differences(modes: Modes, damping_ratio: float, time_step: float) -> Recurrence:
    """Central differences of eq. (1) in modal coordinates, the paper's explicit scheme.

    Parameters
    ----------
    modes : Modes
        Natural frequencies and tip displacements.
    damping_ratio : float
        ξ of every mode.
    time_step : float
        h, s.

    Raises
    ------
    ValueError
        If the scheme is unstable at this step for the highest mode (``ω h ≥ 2``).
    """
    x = modes.omega * time_step
    if x[-1] >= 2.0:
        limit = 2.0 / modes.omega[-1]
        raise ValueError(
            f"time step {time_step:.3g} s: central differences need less than {limit:.3g} s "
            f"for the highest mode of this blade ({modes.omega[-1] / (2 * np.pi):.3g} Hz)"
        )
    implicit = 1.0 + damping_ratio * x
    gain = time_step**2 / implicit
    return Recurrence(
        now=(2.0 - x**2) / implicit,
        before=(1.0 - damping_ratio * x) / implicit,
        response=modes.tip * gain,
        loss=damping_ratio * modes.omega / (2.0 * time_step),
        tip=modes.tip,
        compliance=(modes.tip * gain) @ modes.tip.T,
    )
