"""Validation of a reduced blade from a file of unknown origin."""

import os
from numbers import Real
from pathlib import Path

import h5py
import numpy as np

from bladerub.blade.model import ReducedBlade, read_reduced_blade
from bladerub.io.errors import DamagedFile
from bladerub.numerics.lanes import FEWEST_NODES, MOST_NODES

LARGEST_MATRIX = 10_000  # coordinates of a reduced blade; more would fill the memory

_OF_NODES = ("node_position", "radial_direction", "tangential_direction", "tip_slope")
_POSITIVE = ("f1_hz", "f_omega_max", "length")


def read_valid_blade(path: str | Path) -> ReducedBlade:
    """Read a reduced blade and check that runs can be computed with it.

    Raises an OSError if the file is missing, unreadable or not a reduced blade, a ValueError if a matrix, a
    node or an attribute is invalid; the messages name the file and the dataset.
    """
    if os.path.exists(path) and not os.path.isfile(path):
        kind = "a folder" if os.path.isdir(path) else "not a regular file"
        raise OSError(f"{path}: is {kind}, must be a reduced blade (HDF5)")
    if h5py.is_hdf5(path):
        _check_sizes(path)
    blade = read_reduced_blade(path)
    try:
        _check(blade)
    except ValueError as error:
        raise ValueError(f"{path}: not a valid reduced blade, {error}") from error
    return blade


def _check_sizes(path: str | Path) -> None:
    """Check that the datasets fit into memory before they are read."""
    try:
        with h5py.File(path, "r") as file:
            sizes = {name: getattr(entry, "shape", None) for name, entry in file.items()}
    except (OSError, RuntimeError, KeyError) as error:
        raise DamagedFile(f"{path}: not a readable HDF5 file ({error})") from error
    for name, shape in sizes.items():
        if shape is None or max(shape, default=0) > LARGEST_MATRIX:
            raise ValueError(f"{path}: not a reduced blade, {name} has the shape {shape}")


def _check(blade: ReducedBlade) -> None:
    for name in _POSITIVE:
        value = getattr(blade, name)
        if not (isinstance(value, Real) and 0 < value < np.inf):
            raise ValueError(f"{name} = {value!r}: must be a number above 0")
    n = len(blade.mass) if np.ndim(blade.mass) else 0
    n_nodes = len(blade.node_position) if np.ndim(blade.node_position) else 0
    if not FEWEST_NODES <= n_nodes <= MOST_NODES:
        raise ValueError(f"node_position: has {n_nodes} nodes, must have {FEWEST_NODES} to {MOST_NODES}")
    for name, values in blade.arrays.items():
        is_matrix, size = name not in _OF_NODES, max(n, 3 * n_nodes)
        shape = (size, size) if is_matrix else (n_nodes, size if name == "tip_slope" else 3)
        if values.shape != shape or values.dtype.kind != "f":
            raise ValueError(
                f"{name}: must be numbers of the shape {shape}, is {values.dtype} {values.shape}"
            )
        if not np.all(np.isfinite(values)):
            raise ValueError(f"{name}: must be finite, has NaN or infinite entries")
        tolerance = 1e-6 * np.abs(values).max()
        if is_matrix and not np.allclose(values, values.T, rtol=0, atol=tolerance):
            raise ValueError(f"{name}: must be symmetric")
    try:
        np.linalg.cholesky(blade.mass)
    except np.linalg.LinAlgError as error:
        raise ValueError("mass: must be positive definite") from error
