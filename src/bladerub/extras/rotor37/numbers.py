"""The numbers that other codes can be compared with: of the blade, of direct contact, of coatings."""

from contextlib import suppress

import numpy as np
import pandas as pd

from bladerub.blade.frequencies import reduced_frequencies, tip_lean
from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.extras.blades.similarity import tip_stiffness
from bladerub.settings.study import Config
from bladerub.study import divergence, peaks
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import peak_settings
from bladerub.study.spectra import order_spectrum

COLUMNS = ["number", "value", "unit", "resolution"]  # the last is that of the grid they are read from
ORDERS = (4, 6, 8, 10, 12)  # engine orders whose crossing with the first frequency lies within the speeds
_N_FREQUENCIES = 6
_LAST = 5  # revolutions at the end over which a response counts as steady


def of_blade(config: Config, blade: ReducedBlade) -> pd.DataFrame:
    """Frequencies at rest and at the nominal speed, and what contact meets at the tip."""
    nominal, lean = nominal_speed(config, blade), tip_lean(blade)
    rows = []
    for place, f_omega in (("rest", 0.0), ("nominal", nominal)):
        frequencies = reduced_frequencies(blade, f_omega, _N_FREQUENCIES)
        rows += [(f"f{mode}_{place}", f, "Hz") for mode, f in enumerate(frequencies, 1)]
    rows += [("tip_radius", blade.tip_radius, "m"), ("tip_stiffness", tip_stiffness(blade), "N/m")]
    rows += [("lean_leading_edge", lean[0], "1"), ("lean_trailing_edge", lean[-1], "1")]
    return _numbers(rows)


def nominal_speed(config: Config, blade: ReducedBlade) -> float:
    """``figures.nominal_speed``, the design speed, normalised by the first frequency of `blade`."""
    return config.figures.nominal_speed / 60 / blade.f1_hz


def of_direct_contact(name: str, result: RunResult, revolutions: int) -> pd.DataFrame:
    """Measure a run: the displacement of node 1, and how many of the steps have contact."""
    share = _numbers([(f"{name}.contact_share", result.n_contact_steps / result.n_steps, "1")])
    return pd.concat([of_displacement(name, result.radial_displacement, revolutions), share])


def of_displacement(name: str, radial_displacement: np.ndarray, revolutions: int) -> pd.DataFrame:
    """Extremes and harmonics of the radial displacement of node 1 in the last revolutions of a run."""
    displacement = radial_displacement.reshape(revolutions, -1)[-_LAST:]
    order, amplitude = order_spectrum(radial_displacement, revolutions, _LAST, float(max(ORDERS)))
    values = {"highest": displacement.max(), "lowest": displacement.min()}
    values["amplitude"] = np.ptp(displacement) / 2
    values |= {f"order_{k}": amplitude[np.argmin(abs(order - k))] for k in (2, *ORDERS)}
    return _numbers([(f"{name}.{quantity}", value, "m") for quantity, value in values.items()])


def of_coating(config: Config, coating: CoatingMap, blade: ReducedBlade) -> pd.DataFrame:
    """Peaks (where a run near a crossing stays bounded), wear and divergence of a coating over its speeds."""
    name, rpm = coating.case.name, 60 * blade.f1_hz
    step, settings = float(np.diff(coating.f_omega).max()), peak_settings(config, coating.case.casing)
    rows = []
    for order in ORDERS:
        with suppress(ValueError):  # the spectra do not reach it
            peak, place = peaks.peak(coating, order, settings), f"{name}.order_{order}"
            rows.append((f"{place}.speed", peak.f_omega * rpm, "1/min", step * rpm))
            rows.append((f"{place}.amplitude", peak.amplitude, "m", 0.0))
    divergent = [verdict.divergent for verdict in divergence.verdicts(config, coating)]
    rows.append((f"{name}.divergent_share", float(np.mean(divergent)), "1", 1 / len(divergent)))
    if not coating.case.is_rigid:
        nominal = int(np.argmin(abs(coating.f_omega - nominal_speed(config, blade))))
        rows += [
            (f"{name}.wear_at_nominal", coating.max_wear[nominal], "m", 0.0),
            (f"{name}.deepest_wear", coating.max_wear.max(), "m", 0.0),
            (f"{name}.wear_harmonic_at_nominal", float(coating.wear_harmonic[nominal]), "1", 0.0),
        ]
    return pd.DataFrame(rows, columns=COLUMNS)


def _numbers(rows: list[tuple[str, float, str]]) -> pd.DataFrame:
    return pd.DataFrame([(*row, 0.0) for row in rows], columns=COLUMNS)
