"""Frequencies of the finite element model, of eq. (2) and of the reduced model, side by side."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from scipy.linalg import eigh

from bladerub.blade.model import ReducedBlade

CAMPBELL_COLUMNS = ["f_omega", "mode", "f_fe", "f_rom"]
ACCURACY_COLUMNS = ["f_omega", "mode", "f_fe", "f_fe_eq2", "f_rom", "relative_error"]


def reduced_frequencies(blade: ReducedBlade, f_omega: float, n_modes: int | None = None) -> np.ndarray:
    """Lowest `n_modes` frequencies (all if not given) of the reduced model at `f_omega`, Hz."""
    last = len(blade.mass) if n_modes is None else n_modes
    squares = eigh(blade.stiffness(f_omega), blade.mass, eigvals_only=True, subset_by_index=[0, last - 1])
    return np.sign(squares) * np.sqrt(np.abs(squares)) / (2 * np.pi)


def accuracy_table(
    blade: ReducedBlade, finite_element: Mapping[float, np.ndarray], speed_law: Mapping[float, np.ndarray]
) -> pd.DataFrame:
    """Table of `ACCURACY_COLUMNS`: one row for each speed and mode, frequencies in Hz.

    Parameters
    ----------
    blade : ReducedBlade
        Gives ``f_rom``: eq. (2) and the reduction together.
    finite_element : mapping of float to ndarray
        At each normalised speed the frequencies about the true equilibrium, ``f_fe``.
    speed_law : mapping of float to ndarray
        The same with the stiffness of eq. (2), unreduced, ``f_fe_eq2``: tells the error of the
        interpolation over the speed from that of the reduction.

    Returns
    -------
    DataFrame
        ``relative_error`` is ``f_rom / f_fe - 1``; modes count from 1.
    """
    rows = []
    for f_omega, frequencies in finite_element.items():
        reduced = reduced_frequencies(blade, f_omega, len(frequencies))
        for mode, (f_fe, f_eq2, f_rom) in enumerate(
            zip(frequencies, speed_law[f_omega], reduced, strict=True), 1
        ):
            rows.append((f_omega, mode, f_fe, f_eq2, f_rom, f_rom / f_fe - 1))
    return pd.DataFrame(rows, columns=ACCURACY_COLUMNS)
