"""Frequencies of the finite element model, of eq. (2) and of the reduced model, side by side."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from bladerub import plugins
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade

CAMPBELL_COLUMNS = ["f_omega", "mode", "f_fe", "f_rom"]
ACCURACY_COLUMNS = ["f_omega", "mode", "f_fe", "f_fe_eq2", "f_rom", "relative_error"]


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
        columns = frequencies, speed_law[f_omega], reduced_frequencies(blade, f_omega, len(frequencies))
        for mode, (f_fe, f_eq2, f_rom) in enumerate(zip(*columns, strict=True), 1):
            rows.append((f_omega, mode, f_fe, f_eq2, f_rom, f_rom / f_fe - 1))
    return pd.DataFrame(rows, columns=ACCURACY_COLUMNS)


def doubts(table: pd.DataFrame, nominal_speed: float | None = None) -> list[str]:
    """Name what makes the frequencies of a reduced blade doubtful, with the cure: a line each.

    `table` is an `accuracy_table` that begins at rest, `nominal_speed` that of the rotor, 1/min, if known.
    """
    return [line for judge in plugins.loaded("DOUBTS").values() for line in judge(table, nominal_speed)]
