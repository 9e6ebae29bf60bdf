"""Maps: wear and spectra of one coating over all its speeds."""

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import asdict, dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import Annotated

import numpy as np

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade, interface_node
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.values import Comparable
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import ManifestRow, confirmation_path
from bladerub.study.store import HALF_RANGE, LARGEST, MAPPED, StoredRun, read_run
from bladerub.study.wear import dominant_harmonic, lobes

_SCALES = {"angle", "spectrum_order"}  # the same of all runs
_LONGER = "confirmation_revolution_number"
_STRONGEST = "harmonic of the casing angle strongest in the worn depth"
DERIVED = {
    "wear_harmonic": (("f_omega",), "1", f"{_STRONGEST}; 0: no wear"),
    "wear_harmonic_share": (("f_omega",), "1", f"share of the {_STRONGEST} in its variance"),
}
"""The same of what a map holds for its readers, and computes from the others."""


@dataclass(frozen=True, eq=False)
class CoatingMap(Comparable):
    """All runs of one coating in the order of speed: the arrays are the `DATASETS`.

    Displacements are NaN after an unbounded end. ``confirmation_amplitude`` is NaN for runs without a longer
    one and has no columns if none has one. ``wear_node``, most of a file, is None where it was not read.
    """

    case: CoatingCase
    f_omega: Annotated[np.ndarray, ("f_omega",), "1", "rotational frequency over the first frequency at rest"]
    C1: Annotated[np.ndarray, ("f_omega",), "1", "first eigenfrequency at speed over that at rest"]
    angle: Annotated[np.ndarray, ("angle",), "rad", "casing angle of the element centres"]
    wear: Annotated[np.ndarray, ("f_omega", "angle"), "m", "worn depth, mean over the interface nodes"]
    wear_node: Annotated[
        np.ndarray | None, ("f_omega", "node", "angle"), "m", "worn depth under each interface node"
    ]
    spectrum_order: Annotated[np.ndarray, ("spectrum_order",), "1", "engine order"]
    spectrum_amplitude: Annotated[
        np.ndarray, ("f_omega", "spectrum_order"), "m", "amplitude of the radial displacement of node 1"
    ]
    revolution_peak: Annotated[np.ndarray, ("f_omega", "revolution_number"), "m", LARGEST]
    revolution_amplitude: Annotated[np.ndarray, ("f_omega", "revolution_number"), "m", HALF_RANGE]
    confirmation_amplitude: Annotated[
        np.ndarray, ("f_omega", _LONGER), "m", f"{HALF_RANGE} of the longer run"
    ]
    max_wear: Annotated[np.ndarray, ("f_omega",), "m", "greatest worn depth under any node"]
    lobes: Annotated[np.ndarray, ("f_omega",), "1", "number of worn lobes"]
    status: Annotated[
        np.ndarray, ("f_omega",), "1", "completed, or unbounded: the tip exceeded the displacement limit"
    ]

    @cached_property
    def wear_harmonic(self) -> np.ndarray:
        """Harmonic (n,) that is strongest in the wear, see `bladerub.study.wear.dominant_harmonic`."""
        return np.array([harmonic for harmonic, _ in self._harmonics])

    @cached_property
    def wear_harmonic_share(self) -> np.ndarray:
        """Share (n,) of that harmonic in the variance of the worn depth."""
        return np.array([share for _, share in self._harmonics])

    @cached_property
    def _harmonics(self) -> list[tuple[int, float]]:
        return [dominant_harmonic(wear) for wear in self.wear]


DATASETS: dict[str, tuple[tuple[str, ...], str, str]] = {
    field.name: field.type.__metadata__ for field in fields(CoatingMap) if field.name != "case"
}
"""Dimensions, unit and meaning of each dataset of a map."""


def first_frequency(blade: ReducedBlade, speeds: Sequence[float]) -> np.ndarray:
    """Return the first eigenfrequency C1 of the blade at each of the speeds (n,), both normalised."""
    return np.array([reduced_frequencies(blade, f, n_modes=1)[0] for f in speeds]) / blade.f1_hz


def collect_listed(
    config: Config, case: CoatingCase, blade: ReducedBlade, folder: str | Path, rows: Iterable[ManifestRow]
) -> CoatingMap:
    """Collect the runs of one coating in `folder` that these `rows` of its manifest list.

    ``analysis.lobe_prominence`` of the study `config` decides what counts as a lobe; `blade` is for its first
    frequency. Raises `OSError`, naming the file, if a run is missing, damaged, or not that of its row.
    """
    folder, rows = Path(folder), sorted(rows, key=lambda row: row.f_omega)

    def read_listed(path: Path, key: str, datasets: Set[str]) -> StoredRun:
        run = read_run(path, datasets, {"status"})
        if run.attributes["run_key"] != key:
            raise DamagedFile(f"{path}: not the run that {folder / 'manifest.tsv'} lists, its key differs")
        return run

    runs, longer = [], []
    for row in rows:
        path, key = folder / row.file, row.confirmation_key
        runs.append(read_listed(path, row.run_key, MAPPED if runs else MAPPED | _SCALES))
        longer.append(read_listed(confirmation_path(path), key, {"revolution_amplitude"}) if key else None)
    return collect(config, case, blade, [row.f_omega for row in rows], runs, longer)


def collect(
    config: Config,
    case: CoatingCase,
    blade: ReducedBlade,
    speeds: Sequence[float],
    runs: Sequence[StoredRun],
    longer: Sequence[StoredRun | None],
) -> CoatingMap:
    """Collect runs of one coating at ascending speeds (normalised), and their longer runs or None.

    Of the first run all datasets are needed, of the others `MAPPED`, of the longer ones the amplitude. Other
    parameters are those of `collect_listed`.
    """
    prominence = config.analysis.lobe_prominence
    scales = {name: runs[0].data[name] for name in _SCALES}
    collected = {name: np.stack([run.data[name] for run in runs]) for name in MAPPED}
    wear = collected.pop("wear")
    longest = max((run.data["revolution_amplitude"].size for run in longer if run), default=0)
    none = np.full(longest, np.nan)
    return CoatingMap(
        case=case,
        f_omega=np.array(speeds),
        C1=first_frequency(blade, speeds),
        wear=np.stack([run_wear.mean(axis=0) for run_wear in wear]),
        wear_node=wear,
        confirmation_amplitude=np.stack(
            [run.data["revolution_amplitude"] if run else none for run in longer]
        ),
        max_wear=wear.max(axis=(1, 2)),
        lobes=np.array([lobes(scales["angle"], run_wear, prominence) for run_wear in wear]),
        status=np.array([run.attributes["status"] for run in runs]),
        **scales,
        **collected,
    )


def write_map(path: str | Path, coating: CoatingMap, origin: Mapping[str, str]) -> None:
    """Write `coating` to the HDF5 file `path`, whole or not at all; `origin` is its provenance."""
    hdf5.write(path, variables(coating), asdict(coating.case), origin)


def variables(coating: CoatingMap) -> dict[str, hdf5.Variable]:
    """Give the arrays of a map their dimensions, units and meaning."""
    described = {
        name: hdf5.Variable(dims, getattr(coating, name), units, long_name)
        for name, (dims, units, long_name) in (DATASETS | DERIVED).items()
        if getattr(coating, name) is not None
    }
    if coating.wear_node is not None:
        described["node"] = interface_node(coating.wear_node.shape[1])
    return described | revolutions(described)


def revolutions(described: Mapping[str, hdf5.Variable]) -> dict[str, hdf5.Variable]:
    """Count the revolutions of the amplitudes in a map, and of those of the longer runs."""
    amplitudes = (described[name] for name in ("revolution_amplitude", "confirmation_amplitude"))
    sizes = {amplitude.dims[-1]: amplitude.data.shape[-1] for amplitude in amplitudes}
    return {dim: hdf5.numbers(dim, size, "revolution, counted from 1") for dim, size in sizes.items()}


def read_map(path: str | Path, with_nodes: bool = False) -> CoatingMap:
    """Read a map, `with_nodes` all of it; raises `OSError`, naming the file, if it is none, or damaged."""
    unread = {} if with_nodes else {"wear_node": None}
    data, attributes = hdf5.read(path, DATASETS.keys() - unread)
    try:
        arrays = {name: data[name] for name in DATASETS if name not in unread}
        return CoatingMap(CoatingCase.described(attributes), **arrays, **unread)
    except KeyError as error:
        raise DamagedFile(f"{path}: not a map, {error} is missing") from error
