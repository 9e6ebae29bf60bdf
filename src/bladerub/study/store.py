"""Runs on disk: one HDF5 file a run, or several runs in one, with a prefix before the names of each."""

from collections.abc import Mapping, Set
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from bladerub import plugins
from bladerub.blade.model import interface_node
from bladerub.contact.result import ENERGIES, RunResult
from bladerub.contact.spec import PLASTIC, RunSpec
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.settings.analysis import Analysis
from bladerub.study.grid import CoatingCase
from bladerub.study.spectra import order_spectrum

LARGEST = "largest absolute radial displacement of node 1 in each revolution"
HALF_RANGE = "half the range of the radial displacement of node 1 in each revolution"

_DATASETS = {
    "angle": (("angle",), "rad", "casing angle of the element centres"),
    "wear": (("node", "angle"), "m", "permanent shortening of the coating under each interface node"),
    "spectrum_order": (("spectrum_order",), "1", "engine order"),
    "spectrum_amplitude": (("spectrum_order",), "m", "amplitude of the radial displacement of node 1"),
    "revolution_number": (("revolution_number",), "1", "revolution, counted from 1"),
    "revolution_peak": (("revolution_number",), "m", LARGEST),
    "revolution_amplitude": (("revolution_number",), "m", HALF_RANGE),
    **{f"energy_{name}": ((), "J", long_name) for name, long_name in ENERGIES.items()},
    "revolution": (("revolution",), "1", "time in revolutions from the start"),
    "radial_displacement": (("revolution",), "m", "radial displacement of node 1"),
}

_COUNTERS = (
    *("time_step", "n_steps", "n_contact_steps", "n_reversed_steps", "n_fallback_steps"),
    *("n_unconverged_steps", "slowest_sliding"),
)

MAPPED = {"wear", "spectrum_amplitude", "revolution_peak", "revolution_amplitude"}
"""What the map of a coating needs of each run."""


@dataclass(frozen=True)
class StoredRun:
    """What is stored of a run: its attributes, and its datasets by name in SI units.

    The datasets are ``wear`` (j, n), ``angle`` (n,), ``spectrum_order`` and ``spectrum_amplitude`` (m,),
    ``revolution_peak``, ``revolution_amplitude`` and ``revolution_number`` (r,), ``energy_*`` (scalars), and
    for runs with history ``radial_displacement`` over ``revolution`` (r n,); and what the `layer` has.
    """

    attributes: dict[str, Any]
    data: dict[str, np.ndarray]

    @property
    def layer(self) -> dict[str, np.ndarray]:
        """What else than wear the law of the coating leaves in the elements (j, n), by name."""
        shape = datasets()["wear"][0]
        layers = {name for name, (dims, *_) in datasets().items() if dims == shape} - {"wear"}
        return {name: self.data[name] for name in sorted(layers & self.data.keys())}


def stored_run(
    case: CoatingCase, spec: RunSpec, result: RunResult, run_key: str, analysis: Analysis, keep_history: bool
) -> StoredRun:
    """Take from the outcome of a run what is stored of it, `keep_history` the displacement at all times.

    `run_key` is of `bladerub.study.plan.PlannedRun.key`, `analysis` of the config, for the spectrum.
    """
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis.spectrum_revolutions, analysis.max_order
    )
    data = {
        "angle": result.angle,
        "wear": result.wear.astype(np.float32),  # 1e-7 of a depth known to 1e-2
        **{name: values.astype(np.float32) for name, values in result.layer.items()},
        "spectrum_order": order,
        "spectrum_amplitude": amplitude,
        "revolution_number": np.arange(1, spec.revolutions + 1),
        "revolution_peak": result.revolution_peak,
        "revolution_amplitude": result.revolution_amplitude,
        **{f"energy_{name}": np.asarray(getattr(result.energy, name)) for name in ENERGIES},
    }
    if keep_history:
        n_samples = result.radial_displacement.size
        data["revolution"] = (np.arange(n_samples) + 0.5) * spec.revolutions / n_samples
        data["radial_displacement"] = result.radial_displacement
    attributes = {
        **asdict(case),
        "f_omega": spec.f_omega,
        "revolutions": spec.revolutions,
        **{name: getattr(result, name) for name in _COUNTERS},
        "scheme": spec.scheme,
        "energy_residual": result.energy.residual,
        "damping_ratio": spec.damping_ratio,
        "layer_thickness": spec.coating.thickness,
        "run_key": run_key,
        "status": result.status,
        "message": result.message,
    }
    if spec.coating.element_law != PLASTIC:
        attributes["element_law"] = spec.coating.element_law.label
    return StoredRun(attributes, data)


@cache
def datasets() -> dict[str, tuple[tuple[str, ...], str, str]]:
    """Return dimensions, unit and meaning of all that a run file may hold, by name."""
    parts = [_DATASETS, *plugins.loaded("DATASETS").values()]
    return {name: entry for part in parts for name, entry in part.items()}


def write_run(path: str | Path, run: StoredRun, origin: Mapping[str, str]) -> None:
    """Write one run to `path`, whole or not at all; `origin` is of `bladerub.io.provenance.provenance`."""
    hdf5.write(path, *joined({"": run}), origin)


def joined(runs: Mapping[str, StoredRun]) -> tuple[dict[str, Variable], dict[str, Any]]:
    """Return variables and attributes of `runs`, whose names, also of dimensions, begin with their prefix.

    The prefix of one of them is empty: its names are those in the file of a single run.
    """
    variables, attributes = {}, {}
    for prefix, run in runs.items():
        variables[f"{prefix}node"] = interface_node(len(run.data["wear"]), f"{prefix}node")
        for name, values in run.data.items():
            dims, unit, meaning = datasets()[name]
            variables[prefix + name] = Variable(tuple(prefix + dim for dim in dims), values, unit, meaning)
        attributes |= {prefix + name: value for name, value in run.attributes.items()}
    return variables, attributes


def read_run(
    path: str | Path, only: Set[str] | None = None, attribute_names: Set[str] | None = None
) -> StoredRun:
    """Read one run, or `only` these datasets and `attribute_names`; raises `OSError`, naming the file."""
    data, attributes = hdf5.read(path, only, attribute_names and attribute_names | {"run_key"})
    return _checked(path, StoredRun(attributes, data), only or MAPPED)


def read_runs(path: str | Path) -> dict[str, StoredRun]:
    """Read the runs in a file, which are `joined` there, by their prefix; raises as `read_run`."""
    data, attributes = hdf5.read(path)
    prefixes = {"", *(name.removesuffix("run_key") for name in attributes if name.endswith("run_key"))}
    runs = {}
    for prefix in sorted(prefixes, key=len, reverse=True):  # the empty one takes what the others leave
        parts = [
            {name.removeprefix(prefix): values.pop(name) for name in list(values) if name.startswith(prefix)}
            for values in (attributes, data)
        ]
        runs[prefix] = _checked(path, StoredRun(*parts), MAPPED, prefix)
    return runs


def _checked(path: str | Path, run: StoredRun, names: Set[str], prefix: str = "") -> StoredRun:
    if missing := names - run.data.keys() | {"run_key"} - run.attributes.keys():
        listed = ", ".join(sorted(prefix + name for name in missing))
        raise DamagedFile(f"{path}: not a run, {listed} missing")
    run.data.pop("node", None)  # the numbers of the nodes, which `joined` adds
    return run
