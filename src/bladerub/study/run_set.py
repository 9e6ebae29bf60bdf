"""Several runs in one file, such as a run with its longer one.

Each run has a prefix before the names of its datasets, dimensions and attributes. That of one run is empty:
its names are those of the file of a single run (`bladerub.study.store`).
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.study import store
from bladerub.study.store import MAPPED, StoredRun

_KEY = "run_key"  # an attribute of every run, by which its prefix is known


def write(path: str | Path, runs: Mapping[str, StoredRun], origin: Mapping[str, str]) -> None:
    """Write `runs` by their prefix to the HDF5 file `path`, whole or not at all, and its provenance."""
    hdf5.write(path, *joined(runs), origin)


def joined(runs: Mapping[str, StoredRun]) -> tuple[dict[str, Variable], dict[str, Any]]:
    """Return datasets and attributes of `runs` by name, as `write` writes them."""
    variables = {
        prefix + name: replace(variable, dims=tuple(prefix + dim for dim in variable.dims))
        for prefix, run in runs.items()
        for name, variable in store.variables(run).items()
    }
    attributes = (
        (prefix + name, value) for prefix, run in runs.items() for name, value in run.attributes.items()
    )
    return variables, dict(attributes)


def read(path: str | Path) -> dict[str, StoredRun]:
    """Read the runs in the file `path` by their prefix.

    Raises `OSError` if the file is missing, damaged or without a run of no prefix; the message names it.
    """
    data, attributes = hdf5.read(path)
    prefixes = [name.removesuffix(_KEY) for name in attributes if name.endswith(_KEY)]
    runs = {
        prefix: _taken(path, prefix, data, attributes) for prefix in sorted(prefixes, key=len, reverse=True)
    }
    if "" not in runs:
        raise DamagedFile(f"{path}: not a run, {_KEY} missing")
    return runs


def _taken(
    path: str | Path, prefix: str, data: dict[str, np.ndarray], attributes: dict[str, Any]
) -> StoredRun:
    """Move what has this prefix, and none that is longer, out of `data` and `attributes`."""
    datasets, described = (
        {name.removeprefix(prefix): values.pop(name) for name in list(values) if name.startswith(prefix)}
        for values in (data, attributes)
    )
    datasets.pop("node", None)  # the numbers of the nodes, which `bladerub.study.store.variables` adds
    if missing := MAPPED - datasets.keys():
        raise DamagedFile(
            f"{path}: not a run, {', '.join(sorted(prefix + name for name in missing))} missing"
        )
    return StoredRun(described, datasets)
