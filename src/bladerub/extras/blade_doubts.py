"""What makes the frequencies of a reduced blade doubtful: errors of eq. (2) and of the reduction."""

from typing import Annotated

import pandas as pd
from pydantic import Field

from bladerub.api.arguments import InputError
from bladerub.config.quantities import checked_number, key_at

MODES = 6  # that the reduced model must follow, as the paper's does with its η
EQ2_ERROR = 0.01
EQ2_FAR_OFF = 0.1  # no blade of metal bends so much by its rotation
REDUCED_ERROR = 0.02


def errors_by_mode(table: pd.DataFrame) -> pd.DataFrame:
    """Largest errors by mode in an `accuracy_table`: of eq. (2) alone, and of that with the reduction."""
    speed_law, reduced_model = (table.f_fe_eq2 / table.f_fe - 1).abs(), table.relative_error.abs()
    return table[["mode"]].assign(speed_law=speed_law, reduced_model=reduced_model).groupby("mode").max()


def percent(error: float) -> str:
    """Write a relative error in percent, in two figures."""
    return f"{float(f'{100 * error:.2g}'):g}"


def doubts(table: pd.DataFrame, nominal_speed: float | str | None = None) -> list[str]:
    """List the doubts of an accuracy table (`blade.frequencies.doubts`); `InputError` for a wrong speed.

    At the speeds of its fit eq. (2) is exact: a table of these alone tells nothing of it.
    """
    if nominal_speed is not None:  # checked as that of a config is; 1/min
        key = key_at("figures.nominal_speed")
        kind = Annotated[float, key.unit, Field(**key.bounds)]
        try:
            nominal_speed = checked_number("figures.nominal_speed", nominal_speed, kind, lambda _: 1.0)
        except ValueError as error:
            raise InputError("nominal_speed", nominal_speed, str(error)) from None
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
