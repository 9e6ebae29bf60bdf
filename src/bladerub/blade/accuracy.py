"""Frequencies of the finite element model, of eq. (2) and of the reduced model, side by side."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade

CAMPBELL_COLUMNS = ["f_omega", "mode", "f_fe", "f_rom"]
ACCURACY_COLUMNS = ["f_omega", "mode", "f_fe", "f_fe_eq2", "f_rom", "relative_error"]


def errors_by_mode(table: pd.DataFrame) -> pd.DataFrame:
    """Largest relative errors over the speeds of an `accuracy_table`, a row for each mode.

    Columns ``speed_law`` for eq. (2) alone and ``reduced_model`` for eq. (2) and the reduction together.
    """
    errors = table[["mode"]].assign(
        speed_law=(table.f_fe_eq2 / table.f_fe - 1).abs(), reduced_model=table.relative_error.abs()
    )
    return errors.groupby("mode").max()


def accuracy_table(
    blade: ReducedBlade, finite_element: Mapping[float, np.ndarray], speed_law: Mapping[float, np.ndarray]
) -> pd.DataFrame:
    """Table of `ACCURACY_COLUMNS`: one row for each speed and mode (from 1), frequencies in Hz.

    ``f_fe`` are those about the true equilibrium at each normalised speed (`finite_element`), ``f_fe_eq2``
    those of the unreduced model with the stiffness of eq. (2) (`speed_law`), ``f_rom`` those of the reduced
    `blade`: eq. (2) and the reduction together. ``relative_error`` is ``f_rom / f_fe - 1``.
    """
    rows = []
    for f_omega, frequencies in finite_element.items():
        reduced = reduced_frequencies(blade, f_omega, len(frequencies))
        for mode, (f_fe, f_eq2, f_rom) in enumerate(
            zip(frequencies, speed_law[f_omega], reduced, strict=True), 1
        ):
            rows.append((f_omega, mode, f_fe, f_eq2, f_rom, f_rom / f_fe - 1))
    return pd.DataFrame(rows, columns=ACCURACY_COLUMNS)
