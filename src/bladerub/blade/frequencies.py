"""Natural frequencies of the reduced blade at speed, and the motion of its tip in the first mode."""

import numpy as np
import scipy  # its parts when they are used: every job of a figure imports this module
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.numerics.once import once


@once(maxsize=256)  # the maps of a small study share its speeds
@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def reduced_frequencies(blade: ReducedBlade, f_omega: float, n_modes: int | None = None) -> np.ndarray:
    """Lowest `n_modes` frequencies (all if not given) of the reduced model at `f_omega`, Hz; read-only."""
    last = len(blade.mass) if n_modes is None else n_modes
    squares = scipy.linalg.eigh(
        blade.stiffness(f_omega), blade.mass, eigvals_only=True, subset_by_index=[0, last - 1]
    )
    frequencies = in_hertz(squares)
    frequencies.flags.writeable = False
    return frequencies


def in_hertz(squares: np.ndarray) -> np.ndarray:
    """Frequencies (Hz) of the eigenvalues `squares` (rad²/s²), those of unstable modes negative."""
    return np.sign(squares) * np.sqrt(np.abs(squares)) / (2 * np.pi)


@threadpool_limits.wrap(limits=1, user_api="blas")
def tip_lean(blade: ReducedBlade) -> np.ndarray:
    """Radial over tangential displacement (j,) of the tip in mode 1 at rest, leading to trailing edge."""
    _, mode = scipy.linalg.eigh(blade.stiffness_0, blade.mass, subset_by_index=[0, 0])
    nodes = mode[: 3 * blade.n_interface].reshape(-1, 3)
    return np.sum(nodes * blade.radial_direction, axis=1) / np.sum(nodes * blade.tangential_direction, axis=1)
