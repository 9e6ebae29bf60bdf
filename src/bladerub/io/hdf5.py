"""HDF5 files with names, units and dimension scales, written whole or not at all.

Each carries its checksum (`bladerub.io.checksum`) as the attribute `CHECKSUM`, which `read` compares.
"""

import io
import math
import os
import re
from collections.abc import Iterator, Mapping, Set
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import h5py
import numpy as np

from bladerub.io import atomic, checksum
from bladerub.io.errors import DamagedFile

CHECKSUM = "checksum"
_READ_AND_WRITE = 1  # H5LT_FILE_IMAGE_OPEN_RW
_COMPRESSED_FROM = 1024  # entries; below, the chunk index costs more than it saves


@dataclass(frozen=True)
class Variable:
    """One dataset with what a reader must know of it."""

    dims: tuple[str, ...]  # a variable named like its only dimension becomes the scale of that
    data: Any  # array_like with ``len(dims)`` dimensions: numbers or strings
    units: str  # SI unit, ``"1"`` for a pure number
    long_name: str  # what it is, in words


def numbers(dim: str, n: int, long_name: str) -> Variable:
    """Return the scale of a dimension whose `n` entries are counted from 1."""
    return Variable((dim,), np.arange(1, n + 1), "1", long_name)


def write(
    path: str | Path,
    variables: Mapping[str, Variable],
    attributes: Mapping[str, Any],
    origin: Mapping[str, str] = MappingProxyType({}),
) -> None:
    """Write datasets and attributes (numbers and strings) by name to `path`, whole or not at all.

    `origin` are more attributes, from `bladerub.io.provenance.provenance`. Raises `ValueError` if two
    variables disagree on the length of a dimension.
    """
    data = {name: np.asarray(variable.data) for name, variable in variables.items()}
    blank = _blank(
        tuple(
            (name, variable.dims, data[name].shape, data[name].dtype.str, variable.units, variable.long_name)
            for name, variable in variables.items()
        ),
        tuple((key, np.asarray(value).dtype.str) for key, value in attributes.items()),
        tuple(origin.items()),
    )
    with h5py.File(h5py.h5f.open_file_image(blank, flags=_READ_AND_WRITE)) as file:
        # past h5py's own indexing, which takes longer than the writing
        for key, value in attributes.items():
            attribute = h5py.h5a.open(file.id, key.encode())
            attribute.write(np.asarray(value, attribute.dtype))
        for name, values in data.items():
            if values.dtype.kind == "U":
                file[name][...] = values
            else:
                space = h5py.h5s.ALL
                h5py.h5d.open(file.id, name.encode()).write(space, space, np.ascontiguousarray(values))
        file.flush()
        image = checksum.seal(file.id.get_file_image())
    with atomic.writing(path, "wb") as stream:
        stream.write(image)


@lru_cache(maxsize=8)
def _blank(layout: tuple, attributes: tuple, origin: tuple) -> bytes:
    """Make a file without values but `origin`: the rest takes several times as long as filling it.

    `layout` has name, dimensions, shape, type, unit and meaning of each dataset.
    """
    with h5py.File(io.BytesIO(), "w") as file:
        for key, kind in attributes:
            file.attrs[key] = "" if "U" in kind else np.zeros((), kind)
        file.attrs[CHECKSUM] = np.bytes_(checksum.BLANK)
        file.attrs.update(origin)
        coordinates_first = sorted(layout, key=lambda entry: entry[1] != (entry[0],))
        for name, dims, shape, kind, units, long_name in coordinates_first:
            if len(shape) != len(dims):
                raise ValueError(f"{name}: {len(shape)} dimensions, but named {dims}")
            dataset = _dataset(file, name, shape, np.dtype(kind), units, long_name)
            if dims == (name,):
                dataset.make_scale(name)
                continue
            for axis, dim in enumerate(dims):
                if dim not in file:
                    index = np.arange(shape[axis])
                    numbers = _dataset(file, dim, index.shape, index.dtype, "1", f"index along {dim}")
                    numbers[...] = index
                    numbers.make_scale(dim)
                scale = file[dim]
                if scale.size != shape[axis]:
                    raise ValueError(f"{name}: dimension {dim} has {shape[axis]}, not {scale.size} entries")
                dataset.dims[axis].attach_scale(scale)
        file.flush()
        return file.id.get_file_image()


def _dataset(
    file: h5py.File, name: str, shape: tuple[int, ...], kind: np.dtype, units: str, long_name: str
) -> h5py.Dataset:
    storage = {}
    if kind.kind == "U":
        kind = h5py.string_dtype()
    elif math.prod(shape) >= _COMPRESSED_FROM:
        storage = {"compression": "gzip", "compression_opts": 1, "shuffle": True, "fletcher32": True}
    dataset = file.create_dataset(name, shape, kind, **storage)
    dataset.attrs["units"] = units
    dataset.attrs["long_name"] = long_name
    return dataset


def read(
    path: str | Path, only: Set[str] | None = None, attribute_names: Set[str] | None = None
) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Read datasets, all or `only` these, and attributes, all or `attribute_names`, of the file at `path`.

    What the file does not have is left out, and so are groups. Raises an `OSError` that names the file if it
    is missing or, as `DamagedFile`, not a whole HDF5 file, or not as it was written.
    """
    with opened(path) as file:
        checksum.is_sealed(path)
        return _datasets(file, only), _attributes(file, attribute_names)


def read_any(path: str | Path) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Read as `read` a file that people may have edited, or other programs written: as it is now."""
    with opened(path) as file:
        return _datasets(file), _attributes(file)


def read_attributes(path: str | Path) -> dict[str, Any]:
    """Read the attributes alone of the file at `path` (see `read`)."""
    with opened(path) as file:
        return _attributes(file)


@contextmanager
def opened(path: str | Path) -> Iterator[h5py.File]:
    """Open the file at `path` to read; what is wrong with it, there or within the block, raises as `read`."""
    try:
        with h5py.File(path, "r") as file:
            yield file
    except DamagedFile:
        raise
    except (OSError, RuntimeError, KeyError, ValueError) as error:  # h5py raises any of them
        number = re.search(r"errno = (\d+)", str(error))  # by which HDF5 reports an error of the system
        code = getattr(error, "errno", None) or int(number[1] if number else 0)
        if code:  # of the system: missing, or not ours to read
            raise OSError(code, os.strerror(code), str(path)) from error
        raise DamagedFile(f"{path}: not a readable HDF5 file ({error})") from error


def _datasets(file: h5py.File, only: Set[str] | None = None) -> dict[str, np.ndarray]:
    data = {}
    for name in file.keys() if only is None else only & file.keys():
        if isinstance(entry := file[name], h5py.Dataset):
            is_text = h5py.check_string_dtype(entry.dtype)
            data[name] = np.array(entry.asstr()[...], dtype=str) if is_text else entry[...]
    return data


def _attributes(file: h5py.File, only: Set[str] | None = None) -> dict[str, Any]:
    names = [name for name in file.attrs if name != CHECKSUM and (only is None or name in only)]
    values = ((name, file.attrs[name]) for name in names)
    return {key: value.item() if isinstance(value, np.generic) else value for key, value in values}
