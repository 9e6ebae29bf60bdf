"""Passages through the speeds, up and down, beside the runs at constant speed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade
from bladerub.contact.sweep import SweepResult, simulate_sweep
from bladerub.extensions.sweep_grid import sweep_spec
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import amplitude_within, maximum, peak, speed_window
from bladerub.study.spectra import order_spectrum

COLUMNS = [
    "casing",
    "E",
    "K",
    "theta",
    "direction",
    "rate",
    "order",
    "f_peak",
    "amplitude",
    "f_peak_constant",
    "amplitude_constant",
    "ratio",
    "survives",
    "status",
    "f_end",
    "max_wear",
    "energy_residual",
    "law",
]
"""Columns of ``sweeps.csv``, a row per passage and engine order."""


@dataclass(frozen=True)
class Passage:
    """One passage, its spectra in the order of the speed.

    Parameters
    ----------
    case : CoatingCase
        The coating.
    direction : str
        ``up`` or ``down``.
    rate : float
        Change of the normalised speed in a second, 1/s.
    status : str
        ``completed`` or ``unbounded``.
    max_wear : float
        Greatest worn depth at the end, m.
    energy_residual : float
        See `bladerub.contact.sweep.SweepResult.residual`.
    speed : (r,) ndarray
        Mean speed of each revolution, in the order of time, normalised.
    revolution_amplitude : (r,) ndarray
        Half the range of the radial displacement of node 1 in each of them, m; NaN after an unbounded end.
    f_omega : (n,) ndarray
        Mean speed of each window of revolutions, ascending, normalised.
    C1 : (n,) ndarray
        First eigenfrequency at those speeds, normalised.
    spectrum_order : (m,) ndarray
        Engine order.
    spectrum_amplitude : (n, m) ndarray
        Amplitude of the radial displacement of node 1 in each window, m.
    """

    case: CoatingCase
    direction: str
    rate: float
    status: str
    max_wear: float
    energy_residual: float
    speed: np.ndarray
    revolution_amplitude: np.ndarray
    f_omega: np.ndarray
    C1: np.ndarray
    spectrum_order: np.ndarray
    spectrum_amplitude: np.ndarray


def make(
    config: Mapping[str, Any],
    case: CoatingCase,
    blade: ReducedBlade,
    direction: str,
    rate: float,
    path: str | Path,
) -> SweepResult:
    """Compute one passage and write it to `path`.

    Parameters
    ----------
    config : mapping
        The study; ``sweeps`` has the ends of the passage, ``analysis`` says how its spectra are made.
    case : CoatingCase
        The coating.
    blade : ReducedBlade
        The blade.
    direction : str
        ``up`` or ``down``.
    rate : float
        Change of the normalised speed in a second, 1/s.
    path : path-like
        The HDF5 file.

    Raises
    ------
    ValueError
        If the passage has fewer revolutions than a spectrum; the message names the rate.
    """
    result = simulate_sweep(blade, sweep_spec(config, case, direction, rate))
    analysis = config["analysis"]
    window, revolutions = analysis["spectrum_revolutions"], result.f_omega.size
    if revolutions < window:
        raise ValueError(
            f"sweeps.rates = {rate:g}: the passage of {case.name} has {revolutions} revolutions, a spectrum "
            f"needs {window}; must be slower"
        )
    f_omega, order, amplitude = _spectra(result, window, analysis["max_order"])
    C1 = np.array([reduced_frequencies(blade, f, n_modes=1)[0] for f in f_omega]) / blade.f1_hz
    variables = {
        "angle": Variable(("angle",), result.angle, "rad", "casing angle of the element centres"),
        "wear": Variable(
            ("node", "angle"), result.wear.astype(np.float32), "m", "worn depth under each node at the end"
        ),
        "speed": Variable(("revolution",), result.f_omega, "1", "mean rotational frequency, normalised"),
        "time": Variable(("revolution",), result.time, "s", "middle of each revolution"),
        "revolution_peak": Variable(
            ("revolution",), result.revolution_peak, "m", "largest absolute radial displacement of node 1"
        ),
        "revolution_amplitude": Variable(
            ("revolution",), result.revolution_amplitude, "m", "half the range of that displacement"
        ),
        "f_omega": Variable(
            ("window",), f_omega, "1", f"mean rotational frequency of {window} revolutions, normalised"
        ),
        "C1": Variable(("window",), C1, "1", "first eigenfrequency at speed over that at rest"),
        "spectrum_order": Variable(("spectrum_order",), order, "1", "engine order"),
        "spectrum_amplitude": Variable(
            ("window", "spectrum_order"),
            amplitude.astype(np.float32),
            "m",
            "amplitude of the radial displacement of node 1",
        ),
    }
    energies = {f"energy_{name}": value for name, value in vars(result.energy).items()}
    about = {
        **asdict(case),
        "direction": direction,
        "rate": rate,
        "status": result.status,
        "message": result.message,
        "n_steps": result.n_steps,
        "n_contact_steps": result.n_contact_steps,
        "energy_residual": result.residual,
        "energy_work_stiffness": result.work_stiffness,
        **energies,
    }
    hdf5.write(path, variables, about, provenance(config))
    return result


def _spectra(result: SweepResult, window: int, max_order: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean speed (n,), ascending, of each `window` of whole revolutions, orders (m,) and spectra (n, m)."""
    track = result.radial_displacement.reshape(result.f_omega.size, -1)
    whole = int(np.isfinite(track).all(axis=1).sum())
    order, _ = order_spectrum(np.zeros(window * result.angle.size), window, window, max_order)
    f_omega, amplitude = [], []
    for start in range(whole - window + 1):
        part = slice(start, start + window)
        f_omega.append(result.f_omega[part].mean())
        amplitude.append(order_spectrum(track[part].ravel(), window, window, max_order)[1])
    ascending = np.argsort(f_omega, kind="stable").astype(int)
    spectra = np.array(amplitude).reshape(-1, order.size)
    return np.array(f_omega, float)[ascending], order, spectra[ascending]


def read(path: str | Path) -> Passage:
    """Read a passage written by `make`.

    Raises
    ------
    OSError
        If the file is missing, damaged or not a passage; the message names it.
    """
    data, about = hdf5.read(path)
    try:
        return Passage(
            CoatingCase.described(about),
            *(about[name] for name in ("direction", "rate", "status")),
            float(data["wear"].max()),
            about["energy_residual"],
            data["speed"],
            data["revolution_amplitude"],
            *(data[name] for name in ("f_omega", "C1", "spectrum_order", "spectrum_amplitude")),
        )
    except KeyError as error:
        raise DamagedFile(f"{path}: not a passage, {error} is missing") from error


def table(
    config: Mapping[str, Any], passages: Iterable[Passage], maps: Mapping[CoatingCase, CoatingMap]
) -> pd.DataFrame:
    """Set the peaks of passages beside those at constant speed.

    The peak of a passage is sought in the window of speeds that it is sought in at constant speed (see
    `bladerub.study.peaks.peak`). It survives where it keeps ``sweeps.survival`` of the amplitude there.

    Parameters
    ----------
    config : mapping
        The study.
    passages : iterable of Passage
        Of any coatings.
    maps : mapping of CoatingCase to CoatingMap
        The same coatings at constant speed.

    Returns
    -------
    DataFrame
        A row per passage and engine order, with `COLUMNS`; no peak where a passage left all bounds before it
        came to the window.

    Raises
    ------
    ValueError
        As `bladerub.study.peaks.peak`.
    """
    settings = config["analysis"]["peaks"]
    rows = []
    for passage in passages:
        case = passage.case
        for order in settings["orders"]:
            constant = peak(maps[case], order, settings)
            window = speed_window(maps[case], order, settings)
            found = maximum(passage, amplitude_within(passage, order, window, settings))
            ratio = found.amplitude / constant.amplitude
            ended = np.flatnonzero(np.isfinite(passage.revolution_amplitude))
            rows.append(
                (
                    *(case.casing, case.E, case.K, case.theta, passage.direction, passage.rate, order),
                    *(found.f_omega, found.amplitude, constant.f_omega, constant.amplitude),
                    *(ratio, bool(ratio >= config["sweeps"]["survival"]), passage.status),
                    *(passage.speed[ended[-1]], passage.max_wear, passage.energy_residual, case.law),
                )
            )
    return pd.DataFrame(rows, columns=COLUMNS)
