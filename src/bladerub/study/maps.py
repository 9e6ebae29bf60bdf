"""Maps: wear and spectra of one coating over all its speeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import INTERFACE_NODE, ReducedBlade
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.study.grid import CoatingCase, speeds
from bladerub.study.manifest import ManifestRow, confirmation_path, read_manifest
from bladerub.study.store import MAPPED, StoredRun, read_run
from bladerub.study.wear import lobes, mean_wear


@dataclass(frozen=True)
class CoatingMap:
    """All runs of one coating side by side.

    Parameters
    ----------
    case : CoatingCase
        The coating.
    f_omega : (n,) ndarray
        Speeds, ascending, normalised.
    C1 : (n,) ndarray
        First eigenfrequency of the reduced blade at each speed, normalised.
    angle : (a,) ndarray
        Casing angle, rad.
    wear : (n, a) ndarray
        Worn depth, mean over the interface nodes, m.
    wear_node : (n, 8, a) ndarray or None
        Worn depth under each node, m; read only where asked for, being most of a map.
    spectrum_order : (m,) ndarray
        Engine order.
    spectrum_amplitude : (n, m) ndarray
        Amplitude of the radial displacement of node 1, m.
    revolution_peak : (n, r) ndarray
        Largest absolute radial displacement of node 1 in each revolution, m.
    revolution_amplitude : (n, r) ndarray
        Half the range of the radial displacement of node 1 in each revolution, m; NaN after an unbounded end.
    confirmation_amplitude : (n, c) ndarray
        The same of the longer runs, m; NaN for runs that have none, without columns if none has.
    max_wear : (n,) ndarray
        Greatest worn depth under any node, m.
    lobes : (n,) ndarray of int
        Number of worn lobes.
    status : (n,) ndarray of str
        ``completed`` or ``unbounded``.
    """

    case: CoatingCase
    f_omega: np.ndarray
    C1: np.ndarray
    angle: np.ndarray
    wear: np.ndarray
    wear_node: np.ndarray | None
    spectrum_order: np.ndarray
    spectrum_amplitude: np.ndarray
    revolution_peak: np.ndarray
    revolution_amplitude: np.ndarray
    confirmation_amplitude: np.ndarray
    max_wear: np.ndarray
    lobes: np.ndarray
    status: np.ndarray


_DATASETS = {
    "f_omega": (("f_omega",), "1", "rotational frequency over the first frequency at rest"),
    "C1": (("f_omega",), "1", "first eigenfrequency at speed over that at rest"),
    "angle": (("angle",), "rad", "casing angle of the element centres"),
    "wear": (("f_omega", "angle"), "m", "worn depth, mean over the interface nodes"),
    "wear_node": (("f_omega", "node", "angle"), "m", "worn depth under each interface node"),
    "spectrum_order": (("spectrum_order",), "1", "engine order"),
    "spectrum_amplitude": (
        ("f_omega", "spectrum_order"),
        "m",
        "amplitude of the radial displacement of node 1",
    ),
    "revolution_peak": (
        ("f_omega", "revolution_number"),
        "m",
        "largest absolute radial displacement of node 1 in each revolution",
    ),
    "revolution_amplitude": (
        ("f_omega", "revolution_number"),
        "m",
        "half the range of the radial displacement of node 1 in each revolution",
    ),
    "confirmation_amplitude": (
        ("f_omega", "confirmation_revolution_number"),
        "m",
        "half the range of the radial displacement of node 1 in each revolution of the longer run",
    ),
    "max_wear": (("f_omega",), "m", "greatest worn depth under any node"),
    "lobes": (("f_omega",), "1", "number of worn lobes"),
    "status": (("f_omega",), "1", "completed, or unbounded: the tip left all bounds"),
}


def build_map(
    config: Mapping[str, Any],
    case: CoatingCase,
    blade: ReducedBlade,
    runs_folder: str | Path,
    path: str | Path,
) -> None:
    """Gather the runs of one coating into the map file `path`.

    Parameters
    ----------
    config : mapping
        The study; its ``analysis.lobe_prominence`` decides what counts as a lobe.
    case : CoatingCase
        The coating.
    blade : ReducedBlade
        For its first frequency at each speed.
    runs_folder : path-like
        Folder of the coating's runs; its ``manifest.tsv`` says which of them belong to the study.
    path : path-like
        The map file, see `CoatingMap` for its datasets.

    Raises
    ------
    OSError
        If the manifest or a run is missing or damaged, if the manifest lists other speeds than the study has,
        or a run is another than the manifest's; the message names the file.
    """
    folder = Path(runs_folder)
    rows = sorted(read_manifest(folder / "manifest.tsv"), key=lambda row: row.f_omega)
    planned = speeds(config)
    if [row.f_omega for row in rows] != list(planned):
        raise DamagedFile(
            f"{folder / 'manifest.tsv'}: lists {len(rows)} speeds, not the {len(planned)} planned"
        )
    runs = [_listed_run(folder, folder / row.file, row.run_key, MAPPED) for row in rows]
    scales = _listed_run(folder, folder / rows[0].file, rows[0].run_key, {"angle", "spectrum_order"}).data
    f_omega = np.array([row.f_omega for row in rows])
    angle = scales["angle"]
    wear = np.stack([run.data["wear"] for run in runs])
    prominence = config["analysis"]["lobe_prominence"]
    coating = CoatingMap(
        case=case,
        f_omega=f_omega,
        C1=np.array([reduced_frequencies(blade, f, n_modes=1)[0] for f in f_omega]) / blade.f1_hz,
        angle=angle,
        wear=np.stack([mean_wear(each) for each in wear]),
        wear_node=wear,
        spectrum_order=scales["spectrum_order"],
        spectrum_amplitude=np.stack([run.data["spectrum_amplitude"] for run in runs]),
        revolution_peak=np.stack([run.data["revolution_peak"] for run in runs]),
        revolution_amplitude=np.stack([run.data["revolution_amplitude"] for run in runs]),
        confirmation_amplitude=_confirmation_amplitude(folder, rows),
        max_wear=wear.max(axis=(1, 2)),
        lobes=np.array([lobes(angle, each, prominence) for each in wear]),
        status=np.array([run.attributes["status"] for run in runs]),
    )
    write_map(path, coating, provenance(config))


def _confirmation_amplitude(folder: Path, rows: Sequence[ManifestRow]) -> np.ndarray:
    amplitudes = {}
    for index, row in enumerate(rows):
        if row.confirmation_key:
            path = confirmation_path(folder / row.file)
            run = _listed_run(folder, path, row.confirmation_key, {"revolution_amplitude"})
            amplitudes[index] = run.data["revolution_amplitude"]
    revolutions = max((amplitude.size for amplitude in amplitudes.values()), default=0)
    gathered = np.full((len(rows), revolutions), np.nan)
    for index, amplitude in amplitudes.items():
        gathered[index] = amplitude
    return gathered


def _listed_run(folder: Path, path: Path, key: str, datasets: Set[str]) -> StoredRun:
    run = read_run(path, datasets)
    if run.attributes["run_key"] != key:
        raise DamagedFile(f"{path}: not the run that {folder / 'manifest.tsv'} lists, its key differs")
    return run


def write_map(path: str | Path, coating: CoatingMap, origin: Mapping[str, str]) -> None:
    """Write `coating` to the HDF5 file `path`, whole or not at all; `origin` is its provenance."""
    variables = {
        name: Variable(dims, getattr(coating, name), units, long_name)
        for name, (dims, units, long_name) in _DATASETS.items()
    }
    variables["node"] = INTERFACE_NODE
    for dim, gathered in (
        ("revolution_number", coating.revolution_amplitude),
        ("confirmation_revolution_number", coating.confirmation_amplitude),
    ):
        number = np.arange(1, gathered.shape[1] + 1)
        variables[dim] = Variable((dim,), number, "1", "revolution, counted from 1")
    hdf5.write(path, variables, asdict(coating.case), origin)


def read_map(path: str | Path, with_nodes: bool = False) -> CoatingMap:
    """Read a map written by `write_map`, `with_nodes` all of it.

    Raises
    ------
    OSError
        If the file is missing, damaged or not a map; the message names it.
    """
    data, attributes = hdf5.read(path, _DATASETS.keys() - (set() if with_nodes else {"wear_node"}))
    try:
        case = CoatingCase.described(attributes)
        if not with_nodes:
            data["wear_node"] = None
        return CoatingMap(case=case, **{name: data[name] for name in _DATASETS})
    except KeyError as error:
        raise DamagedFile(f"{path}: not a map, {error} is missing") from error
