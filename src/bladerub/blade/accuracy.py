"""Frequencies of the finite element model, of eq. (2) and of the reduced model, side by side."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade

CAMPBELL_COLUMNS = ["f_omega", "mode", "f_fe", "f_rom"]
ACCURACY_COLUMNS = ["f_omega", "mode", "f_fe", "f_fe_eq2", "f_rom", "relative_error"]

MODES = 6  # that the reduced model must follow, as the paper's does with its η
EQ2_ERROR = 0.01
EQ2_FAR_OFF = 0.1  # no blade of metal bends so much by its rotation
REDUCED_ERROR = 0.02


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
        columns = frequencies, speed_law[f_omega], reduced_frequencies(blade, f_omega, len(frequencies))
        for mode, (f_fe, f_eq2, f_rom) in enumerate(zip(*columns, strict=True), 1):
            rows.append((f_omega, mode, f_fe, f_eq2, f_rom, f_rom / f_fe - 1))
    return pd.DataFrame(rows, columns=ACCURACY_COLUMNS)


def percent(error: float) -> str:
    """Write a relative error in percent, in two figures."""
    return f"{float(f'{100 * error:.2g}'):g}"


def doubts(table: pd.DataFrame, nominal_speed: float | None = None) -> list[str]:
    """Name what makes the frequencies of a reduced blade doubtful, with the cure: a line each.

    `table` is an `accuracy_table` that begins at rest, `nominal_speed` that of the rotor, 1/min, if known.
    At the speeds of its fit eq. (2) is exact: a table of these alone tells nothing of it.
    """
    lines = []
    eq2, reduced = errors_by_mode(table)[:MODES].max()
    fastest, f1_hz = table.f_omega.max(), table.f_fe.iloc[0]
    nominal = (nominal_speed or 0.0) / 60 / f1_hz
    off = f"% off in the first {MODES} modes"
    speed = f"the nominal speed of {nominal_speed:g} 1/min is f_omega = {nominal:.4g}" if nominal else ""
    beyond = f"{speed}, beyond reduction.f_omega_max = {fastest:g}" if nominal > fastest else ""
    tolerance = f"set reduction.tolerance to {EQ2_ERROR:g} (not for matrices)"
    if eq2 > EQ2_FAR_OFF:
        what = "radius, length and thickness in one unit, the angles in theirs, and the material in Pa, kg/m³"
        cure = "if so, lower reduction.f_omega_max, or raise reduction.fit_speeds"
        lines.append(f"eq. (2) is up to {percent(eq2)} {off}: are {what}? {cure}")
    elif eq2 > EQ2_ERROR:
        cure = f"raise that and {tolerance}" if beyond else f"lower reduction.f_omega_max, or {tolerance}"
        lines.append(f"eq. (2) is up to {percent(eq2)} {off}{beyond and f', and {beyond}'}: {cure}")
    if beyond and not EQ2_ERROR < eq2 <= EQ2_FAR_OFF:
        lines.append(f"{beyond}: raise that")
    if eq2 <= EQ2_FAR_OFF and reduced > max(REDUCED_ERROR, 1.5 * eq2):
        cure = "set reduction.tolerance, or raise reduction.modes_per_speed"
        lines.append(f"the reduced model is up to {percent(reduced)} {off}: {cure}")
    if table.f_fe.min() <= 0:
        lines.append("a mode is unstable within the range of speeds: lower reduction.f_omega_max")
    return lines
