"""Speed sweeps: run-up and run-down at a constant rate, compared with the runs at constant speed."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade, interface_node
from bladerub.extras.passages.speed_sweep import SweepResult, simulate_sweep
from bladerub.extras.passages.sweep_grid import sweep_spec
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap, first_frequency
from bladerub.study.peaks import amplitude_in_window, maximum, peak, peak_orders, speed_window
from bladerub.study.spectra import order_spectrum
from bladerub.study.variants import with_variant

COLUMNS = [
    *("casing", "E", "K", "theta", "direction", "rate", "order", "f_peak", "amplitude"),
    *("f_peak_constant", "amplitude_constant", "ratio", "survives"),
    *("status", "f_end", "max_wear", "energy_residual", "law"),
]
"""Columns of ``sweeps.csv``."""

_RADIAL = "radial displacement of node 1"
_DATASETS = {
    "angle": (("angle",), "rad", "casing angle of the element centres"),
    "wear": (("node", "angle"), "m", "worn depth under each node at the end"),
    "speed": (("revolution",), "1", "mean rotational frequency, normalised"),
    "time": (("revolution",), "s", "middle of each revolution"),
    "revolution_peak": (("revolution",), "m", f"largest absolute {_RADIAL}"),
    "revolution_amplitude": (("revolution",), "m", "half the range of that displacement"),
    "f_omega": (("window",), "1", "mean rotational frequency of {window} revolutions, normalised"),
    "C1": (("window",), "1", "first eigenfrequency at speed over that at rest"),
    "spectrum_order": (("spectrum_order",), "1", "engine order"),
    "spectrum_amplitude": (("window", "spectrum_order"), "m", f"amplitude of the {_RADIAL}"),
}
_DESCRIBED = ("direction", "rate", "status", "energy_residual")  # attributes of the file


@dataclass(frozen=True)
class SpeedSweep:
    """One sweep of r revolutions, with the spectra of its n windows of revolutions sorted by speed."""

    case: CoatingCase
    direction: str  # up or down
    rate: float  # change of the normalised speed per second, 1/s
    status: str  # completed or unbounded
    energy_residual: float  # see `bladerub.extras.passages.speed_sweep.SweepResult.residual`
    max_wear: float  # at the end, m
    speed: np.ndarray  # (r,), mean of each revolution in the order of time, normalised
    revolution_peak: np.ndarray  # (r,), largest |u_r| of node 1, m; NaN after an unbounded end
    revolution_amplitude: np.ndarray  # (r,), half the range of u_r in each whole revolution, m; NaN likewise
    f_omega: np.ndarray  # (n,), mean speed of each window, ascending, normalised
    C1: np.ndarray  # (n,), first eigenfrequency there, normalised
    spectrum_order: np.ndarray  # (m,)
    spectrum_amplitude: np.ndarray  # (n, m), of u_r of node 1, m


def make(
    config: Config, case: CoatingCase, blade: ReducedBlade, direction: str, rate: float, path: str | Path
) -> SweepResult:
    """Compute one sweep, ``up`` or ``down`` at `rate` (1/s), and write it to the HDF5 file `path`."""
    result = simulate_sweep(blade, sweep_spec(config, case, direction, rate))
    window, revolutions = config.analysis.spectrum_revolutions, result.f_omega.size
    if revolutions < window:
        raise ValueError(
            f"sweeps.rates = {rate:g}: the sweep of {case.name} has {revolutions} revolutions, a spectrum "
            f"needs {window}; must be slower"
        )
    f_omega, order, amplitude = _spectra(result, window, config.analysis.max_order)
    values = vars(result) | {
        "wear": result.wear.astype(np.float32),
        "speed": result.f_omega,
        "f_omega": f_omega,
        "C1": first_frequency(blade, f_omega),
        "spectrum_order": order,
        "spectrum_amplitude": amplitude.astype(np.float32),
    }
    variables = {
        name: Variable(dims, values[name], units, long_name.format(window=window))
        for name, (dims, units, long_name) in _DATASETS.items()
    } | {"node": interface_node(len(result.wear))}
    attributes = asdict(case) | {"direction": direction, "rate": rate}
    names = ("status", "message", "n_steps", "n_contact_steps")
    attributes |= {name: getattr(result, name) for name in names}
    attributes |= {"energy_residual": result.residual, "energy_work_stiffness": result.work_stiffness}
    attributes |= {f"energy_{name}": value for name, value in vars(result.energy).items()}
    hdf5.write(path, variables, attributes, provenance(config.plain()))
    return result


def _spectra(result: SweepResult, window: int, max_order: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean speed (n,), ascending, of each `window` of whole revolutions, orders (m,) and spectra (n, m)."""
    track = result.radial_displacement.reshape(result.f_omega.size, -1)
    n_complete = int(np.isfinite(track).all(axis=1).sum())
    order, _ = order_spectrum(np.zeros(window * result.angle.size), window, window, max_order)
    windows = [slice(first, first + window) for first in range(n_complete - window + 1)]
    f_omega = np.array([result.f_omega[part].mean() for part in windows], dtype=float)
    spectra = [order_spectrum(track[part].ravel(), window, window, max_order)[1] for part in windows]
    ascending = np.argsort(f_omega, kind="stable")
    return f_omega[ascending], order, np.array(spectra).reshape(-1, order.size)[ascending]


def read(path: str | Path) -> SpeedSweep:
    """Read a sweep written by `make`; raises `OSError`, naming the file, if it is missing or damaged."""
    data, about = hdf5.read(path)
    try:
        values = about | data | {"case": CoatingCase.described(about), "max_wear": float(data["wear"].max())}
        return SpeedSweep(**{field.name: values[field.name] for field in fields(SpeedSweep)})
    except KeyError as error:
        raise DamagedFile(f"{path}: not a speed sweep, {error} is missing") from error


def table(
    config: Config, sweeps: Iterable[SpeedSweep], maps: Mapping[CoatingCase, CoatingMap]
) -> pd.DataFrame:
    """Compare peaks of sweeps with those at constant speed, in `maps`: a row per sweep and engine order."""
    settings, rows = config.analysis.peaks, []
    pairs = ((sweep, order) for sweep in sweeps for order in peak_orders(config, sweep.case.casing))
    for sweep, order in pairs:
        constant = maps[sweep.case]
        at_constant, window = peak(constant, order, settings), speed_window(constant, order, settings)
        swept_peak = maximum(sweep, amplitude_in_window(sweep, order, settings, window))
        f_end = np.append(np.nan, sweep.speed[np.isfinite(sweep.revolution_peak)])[-1]
        rows.append(
            asdict(sweep.case)
            | {name: getattr(sweep, name) for name in (*_DESCRIBED, "max_wear")}
            | {"order": order, "f_peak": swept_peak.f_omega, "amplitude": swept_peak.amplitude}
            | {"f_peak_constant": at_constant.f_omega, "amplitude_constant": at_constant.amplitude}
            | {"f_end": f_end}
        )
    table = pd.DataFrame(rows)
    table["ratio"] = table.amplitude / table.amplitude_constant
    survives = (table.ratio >= config.sweeps.survival).astype("boolean")
    table["survives"] = survives.mask(~(table.amplitude_constant > 0))
    return with_variant(table, COLUMNS)
