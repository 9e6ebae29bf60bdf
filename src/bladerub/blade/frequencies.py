"""Natural frequencies of the blade at speed: of the finite elements, of eq. (2) and of the reduced model."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import scipy  # its parts when they are used, and no pandas: every job of a figure imports this module
from threadpoolctl import threadpool_limits

from bladerub import plugins
from bladerub.blade.model import ReducedBlade
from bladerub.numerics.once import once

if TYPE_CHECKING:
    import pandas as pd

CAMPBELL_COLUMNS = ["f_omega", "mode", "f_fe", "f_rom"]
ACCURACY_COLUMNS = ["f_omega", "mode", "f_fe", "f_fe_eq2", "f_rom", "relative_error"]


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


def accuracy_table(
    blade: ReducedBlade, finite_element: Mapping[float, np.ndarray], speed_law: Mapping[float, np.ndarray]
) -> "pd.DataFrame":
    """Table of `ACCURACY_COLUMNS`: one row for each speed and mode (from 1), frequencies in Hz.

    ``f_fe`` are those about the true equilibrium at each normalised speed (`finite_element`), ``f_fe_eq2``
    those of the unreduced model with the stiffness of eq. (2) (`speed_law`), ``f_rom`` those of the reduced
    `blade`: eq. (2) and the reduction together. ``relative_error`` is ``f_rom / f_fe - 1``.
    """
    import pandas as pd

    rows = []
    for f_omega, frequencies in finite_element.items():
        columns = frequencies, speed_law[f_omega], reduced_frequencies(blade, f_omega, len(frequencies))
        for mode, (f_fe, f_eq2, f_rom) in enumerate(zip(*columns, strict=True), 1):
            rows.append((f_omega, mode, f_fe, f_eq2, f_rom, f_rom / f_fe - 1))
    return pd.DataFrame(rows, columns=ACCURACY_COLUMNS)


def doubts(table: "pd.DataFrame", nominal_speed: float | None = None) -> list[str]:
    """Name what makes the frequencies of a reduced blade doubtful, with the cure: a line each.

    `table` is an `accuracy_table` that begins at rest, `nominal_speed` that of the rotor, 1/min, if known.
    """
    return [line for judge in plugins.loaded("DOUBTS").values() for line in judge(table, nominal_speed)]
