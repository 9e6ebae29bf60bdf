"""HDF5 files with names, units and dimension scales, written whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Mapping, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

_COMPRESSED_FROM = 1024
"""Entries from which a dataset is compressed; below, the chunk index costs more than it saves."""


@dataclass(frozen=True)
class Variable:
    """One dataset with what a reader must know of it.

    Parameters
    ----------
    dims : tuple of str
        Name of each dimension. A variable that is named like its only dimension is a coordinate
        and becomes that dimension's scale.
    data : array_like
        The values, with ``len(dims)`` dimensions; numbers or strings.
    units : str
        SI unit, ``"1"`` for a pure number.
    long_name : str
        What it is, in words.
    """

    dims: tuple[str, ...]
    data: Any
    units: str
    long_name: str


def write(path: str | Path, variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> None:
    """Write `variables` and `attributes` to `path`: under a temporary name first, then renamed.

    Raises
    ------
    ValueError
        If two variables disagree on the length of a dimension.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        with h5py.File(temporary, "w") as file:
            for key, value in attributes.items():
                file.attrs[key] = value
            _write_variables(file, variables)
            file.flush()
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _write_variables(file: h5py.File, variables: Mapping[str, Variable]) -> None:
    lengths: dict[str, int] = {}
    coordinates_first = sorted(variables, key=lambda name: variables[name].dims != (name,))
    for name in coordinates_first:
        variable = variables[name]
        data = np.asarray(variable.data)
        if data.ndim != len(variable.dims):
            raise ValueError(f"{name}: {data.ndim} dimensions, but named {variable.dims}")
        dataset = file.create_dataset(name, **_storage(data))
        dataset.attrs["units"] = variable.units
        dataset.attrs["long_name"] = variable.long_name
        if variable.dims == (name,):
            lengths[name] = data.size
            dataset.make_scale(name)
            continue
        for axis, dim in enumerate(variable.dims):
            if lengths.setdefault(dim, data.shape[axis]) != data.shape[axis]:
                raise ValueError(
                    f"{name}: dimension {dim} has {data.shape[axis]}, not {lengths[dim]} entries"
                )
            if dim not in file:
                scale = file.create_dataset(dim, data=np.arange(lengths[dim]))
                scale.attrs["units"] = "1"
                scale.attrs["long_name"] = f"index along {dim}"
                scale.make_scale(dim)
            dataset.dims[axis].attach_scale(file[dim])


def _storage(data: np.ndarray) -> dict[str, Any]:
    if data.dtype.kind == "U":
        return {"data": data.astype(object), "dtype": h5py.string_dtype()}
    if data.size < _COMPRESSED_FROM:
        return {"data": data}
    return {"data": data, "compression": "gzip", "shuffle": True, "fletcher32": True}


def read(path: str | Path, only: Set[str] | None = None) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Read the datasets and attributes of the file at `path`.

    Parameters
    ----------
    path : path-like
        The file.
    only : set of str, optional
        Names of the datasets to read, all by default.

    Raises
    ------
    OSError
        If the file is missing or is not a whole HDF5 file; the message names it.
    """
    try:
        with h5py.File(path, "r") as file:
            wanted = file.keys() if only is None else only & file.keys()
            return {name: _values(file[name]) for name in wanted}, _plain_attributes(file)
    except OSError as error:
        raise OSError(f"{path}: not a readable HDF5 file ({error})") from error


def read_attributes(path: str | Path) -> dict[str, Any]:
    """Read the attributes alone of the file at `path` (see `read`)."""
    try:
        with h5py.File(path, "r") as file:
            return _plain_attributes(file)
    except OSError as error:
        raise OSError(f"{path}: not a readable HDF5 file ({error})") from error


def _values(dataset: h5py.Dataset) -> np.ndarray:
    if h5py.check_string_dtype(dataset.dtype):
        return np.array(dataset.asstr()[...], dtype=str)
    return dataset[...]


def _plain_attributes(file: h5py.File) -> dict[str, Any]:
    return {
        key: value.item() if isinstance(value, np.generic) else value for key, value in file.attrs.items()
    }
