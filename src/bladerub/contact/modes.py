"""Modal coordinates of the reduced blade at one speed."""

from typing import NamedTuple

import numpy as np
import scipy.linalg
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.laws import motion
from bladerub.contact.spec import RunSpec
from bladerub.numerics.once import once


class Modes(NamedTuple):
    """Mass-normalised modes seen from the blade tip."""

    omega: np.ndarray  # (n,): Natural angular frequencies, ascending, rad/s
    tip: np.ndarray  # (2 j, n): Displacement of the tip per unit of each mode as of `at_tip`, kg^-1/2
    n_nodes: int  # j


def modes_at(blade: ReducedBlade, f_omega: float, spec: RunSpec | None = None) -> Modes:
    """Find the modes at the normalised speed `f_omega`, as `mode_shapes_at`, and `at_tip` by the `spec`."""
    omega, shapes = mode_shapes_at(blade, f_omega)
    return Modes(omega, at_tip(blade, shapes, spec), blade.n_interface)


@once(maxsize=256)  # coatings and starts share the speeds of a study
@threadpool_limits.wrap(limits=1, user_api="blas")  # whoever asks first: bits depend on the threads
def mode_shapes_at(blade: ReducedBlade, f_omega: float) -> tuple[np.ndarray, np.ndarray]:
    """Diagonalise mass and stiffness, eq. (2), of the blade at the normalised speed `f_omega`.

    Returns the natural angular frequencies (n,), ascending, rad/s, and the reduced coordinates per unit of
    each mode (n, n), mass-normalised, kg^-1/2, both read-only. Raises `ValueError` if `f_omega` is outside
    the fitted range or the stiffness is not positive definite there.
    """
    squares, vectors = scipy.linalg.eigh(blade.stiffness(f_omega), blade.mass)
    if squares[0] <= 0:
        raise ValueError(f"f_omega = {f_omega:g}: the stiffness of the blade is not positive definite")
    omega = np.sqrt(squares)
    for array in (omega, vectors):
        array.flags.writeable = False
    return omega, vectors


def at_tip(blade: ReducedBlade, coordinates: np.ndarray, spec: RunSpec | None = None) -> np.ndarray:
    """Project reduced coordinates (n, k) on the tip (2 j, k): radial at its j nodes, then tangential.

    In the contact that `spec` describes a further motion may follow (3 j, k), see `bladerub.contact.laws`.
    """
    interface = coordinates[: 3 * blade.n_interface].reshape(blade.n_interface, 3, -1)
    radial = np.einsum("ja,jan->jn", blade.radial_direction, interface)
    tangential = np.einsum("ja,jan->jn", blade.tangential_direction, interface)
    rows = [radial, tangential]
    if spec and spec.turns:
        rows.append(motion().further(blade, coordinates, spec))
    return np.ascontiguousarray(np.vstack(rows))


def tip_radii(blade: ReducedBlade) -> tuple[np.ndarray, np.ndarray]:
    """Distance (j,) of each interface node from the axis of rotation, and radius of curvature of its path, m.

    Where the flow path is a cone, its normal section curves less than its circle (Meusnier).
    """
    _, y, z = blade.node_position.T
    radius = np.hypot(y, z)
    outward = (blade.radial_direction[:, 1] * y + blade.radial_direction[:, 2] * z) / radius
    return radius, radius / outward
