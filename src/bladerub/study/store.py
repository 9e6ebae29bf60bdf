"""Runs on disk: one HDF5 file a run, and the manifest of one coating."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Set
from dataclasses import astuple, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from bladerub.blade.model import INTERFACE_NODE
from bladerub.contact.result import RunResult
from bladerub.contact.spec import RunSpec
from bladerub.io import atomic, hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.study.confirmation import confirmation_path
from bladerub.study.grid import CoatingCase
from bladerub.study.spectra import order_spectrum

_ENERGIES = {
    "initial": "energy of the blade at the start",
    "kinetic": "kinetic energy of the blade at the end",
    "elastic": "elastic energy of the blade at the end",
    "damping": "energy dissipated by modal damping",
    "work_radial": "work done on the blade by the radial contact forces",
    "work_tangential": "work done on the blade by the tangential contact forces",
    "stored": "elastic energy in the coating at the end",
    "wear": "energy dissipated by plastic shortening of the coating",
    "work_shape": "work of the rotation in moving the tip over the casing shape and onto new bars",
    "work_rotation": "work of the rotation against the tangential resistance of the coating",
    "sliding": "energy dissipated by the tangential resistance of the coating",
    "exchanged": "work exchanged in the contact, whatever its sign",
}


@dataclass(frozen=True)
class StoredRun:
    """A run as read from its file.

    Parameters
    ----------
    attributes : dict
        ``casing``, ``E``, ``K``, ``theta``, ``law``, ``f_omega``, ``revolutions``, ``time_step``,
        ``n_steps``, ``run_key``, ``status`` and more.
    data : dict of str to ndarray
        The datasets by name, in SI units: ``wear`` (8, n), ``angle`` (n,), ``spectrum_order`` and
        ``spectrum_amplitude`` (m,), ``revolution_peak``, ``revolution_amplitude`` and ``revolution_number``
        (r,), ``energy_*`` (scalars), and for runs with history ``radial_displacement`` over ``revolution``
        (r n,).
    """

    attributes: dict[str, Any]
    data: dict[str, np.ndarray]


def write_run(
    path: str | Path,
    spec: RunSpec,
    result: RunResult,
    case: CoatingCase,
    run_key: str,
    config: Mapping[str, Any],
    keep_history: bool,
) -> None:
    """Write one run to `path`, whole or not at all.

    Parameters
    ----------
    path : path-like
        The file; its folder is made if need be.
    spec, result
        The run and its outcome.
    case : CoatingCase
        Its coating.
    run_key : str
        From `bladerub.study.key.run_key`.
    config : mapping
        The study.
    keep_history : bool
        Whether to store the whole radial displacement of node 1.
    """
    analysis = config["analysis"]
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis["spectrum_revolutions"], analysis["max_order"]
    )
    variables = {
        "node": INTERFACE_NODE,
        "angle": Variable(("angle",), result.angle, "rad", "casing angle of the element centres"),
        "wear": Variable(
            ("node", "angle"),
            result.wear.astype(np.float32),  # 1e-7 of a depth known to 1e-2
            "m",
            "permanent shortening of the coating under each interface node",
        ),
        "spectrum_order": Variable(("spectrum_order",), order, "1", "engine order"),
        "spectrum_amplitude": Variable(
            ("spectrum_order",), amplitude, "m", "amplitude of the radial displacement of node 1"
        ),
        "revolution_number": Variable(
            ("revolution_number",), np.arange(1, spec.revolutions + 1), "1", "revolution, counted from 1"
        ),
        "revolution_peak": Variable(
            ("revolution_number",),
            result.revolution_peak,
            "m",
            "largest absolute radial displacement of node 1 in each revolution",
        ),
        "revolution_amplitude": Variable(
            ("revolution_number",),
            result.revolution_amplitude,
            "m",
            "half the range of the radial displacement of node 1 in each revolution",
        ),
    }
    for name, long_name in _ENERGIES.items():
        variables[f"energy_{name}"] = Variable((), getattr(result.energy, name), "J", long_name)
    if keep_history:
        n_samples = result.radial_displacement.size
        variables["revolution"] = Variable(
            ("revolution",),
            (np.arange(n_samples) + 0.5) * spec.revolutions / n_samples,
            "1",
            "time in revolutions from the start",
        )
        variables["radial_displacement"] = Variable(
            ("revolution",), result.radial_displacement, "m", "radial displacement of node 1"
        )
    attributes = {
        "casing": case.casing,
        "E": case.E,
        "K": case.K,
        "theta": case.theta,
        "law": case.law,
        "f_omega": spec.f_omega,
        "revolutions": spec.revolutions,
        "time_step": result.time_step,
        "n_steps": result.n_steps,
        "n_contact_steps": result.n_contact_steps,
        "n_reversed_steps": result.n_reversed_steps,
        "slowest_sliding": result.slowest_sliding,
        "scheme": spec.scheme,
        "energy_residual": result.energy.residual,
        "damping_ratio": spec.damping_ratio,
        "layer_thickness": spec.coating.thickness,
        "run_key": run_key,
        "status": result.status,
        "message": result.message,
    }
    hdf5.write(path, variables, attributes, provenance(config))


GATHERED = {"wear", "spectrum_amplitude", "revolution_peak", "revolution_amplitude"}
"""What the map of a coating needs of each run."""


def read_run(path: str | Path, only: Set[str] = frozenset()) -> StoredRun:
    """Read one run.

    Parameters
    ----------
    path : path-like
        The file.
    only : set of str, optional
        Names of the datasets to read, all by default.

    Raises
    ------
    OSError
        If the file is missing, damaged or not a run; the message names it.
    """
    data, attributes = hdf5.read(path, only or None)
    missing = (only or GATHERED) - data.keys() | {"run_key"} - attributes.keys()
    if missing:
        raise DamagedFile(f"{path}: not a run, {', '.join(sorted(missing))} missing")
    return StoredRun(attributes, data)


def is_current(path: str | Path, key: str) -> bool:
    """Tell whether `path` holds the whole run that `key` stands for.

    A missing, truncated, foreign or stale file is not current; none of them raises.
    """
    try:
        return read_run(path).attributes["run_key"] == key
    except Exception:  # whatever is wrong with the file, the answer is to compute the run again
        return False


@dataclass(frozen=True)
class ManifestRow:
    """One run in the manifest of a coating.

    Parameters
    ----------
    file : str
        Name of the run file, beside the manifest.
    f_omega : float
        Normalised speed.
    run_key : str
        Key of the run.
    status : str
        ``completed`` or ``unbounded``.
    bytes : int
        Size of the file.
    confirmation_key : str
        Key of the longer run that shows whether its growth lasts; empty if it needs none.
    confirmation_bytes : int
        Size of its file.
    """

    file: str
    f_omega: float
    run_key: str
    status: str
    bytes: int
    confirmation_key: str = ""
    confirmation_bytes: int = 0


_COLUMNS = [field.name for field in fields(ManifestRow)]


def write_manifest(path: str | Path, rows: Iterable[ManifestRow]) -> None:
    """Write the manifest (tab-separated, with a header) to `path`, whole or not at all."""
    with atomic.writing(path) as stream:
        writer = csv.writer(stream, delimiter="\t", lineterminator="\n")
        writer.writerow(_COLUMNS)
        writer.writerows(astuple(row) for row in rows)


def read_manifest(path: str | Path) -> list[ManifestRow]:
    """Read the manifest written by `write_manifest`.

    Raises
    ------
    OSError
        If the file is missing or not a manifest; the message names it.
    """
    with Path(path).open(encoding="utf-8", newline="") as stream:
        reader = csv.reader(stream, delimiter="\t")
        try:
            if next(reader, None) != _COLUMNS:
                raise DamagedFile(f"{path}: not a manifest, its header is not {' '.join(_COLUMNS)}")
            return [
                ManifestRow(file, float(f_omega), key, status, int(size), longer_key, int(longer_size))
                for file, f_omega, key, status, size, longer_key, longer_size in reader
            ]
        except (ValueError, csv.Error) as error:
            raise DamagedFile(f"{path}: not a manifest, line {reader.line_num}: {error}") from error


def lost_run(path: str | Path) -> str | None:
    """Name a file that the manifest at `path` lists and that is missing or has another size, if there is one.

    Raises
    ------
    OSError
        As `read_manifest`.
    """
    folder = Path(path).parent
    for row in read_manifest(path):
        run = folder / row.file
        for file, size in ((run, row.bytes), (confirmation_path(run), row.confirmation_bytes)):
            if size and not (file.is_file() and file.stat().st_size == size):
                return str(file)
    return None
