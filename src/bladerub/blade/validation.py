"""Reduced blades from files, and what they must be, that runs can be computed with them."""

import os
from collections.abc import Mapping
from numbers import Real
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from bladerub.blade.frequencies import in_hertz
from bladerub.blade.model import ReducedBlade, reduced_blade
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.numerics.lanes import FEWEST_NODES, MOST_NODES

LARGEST_MATRIX = 10_000  # coordinates of a reduced blade; more would fill the memory
SAME_FREQUENCY = 0.01  # f1_hz is of the finite elements, or of an edited file
FARTHEST = 1000.0  # m, of a node from the axis or along it

_OF_NODES = ("node_position", "radial_direction", "tangential_direction", "tip_slope")
_POSITIVE = ("f1_hz", "f_omega_max", "length")


def read_reduced_blade(path: str | Path) -> ReducedBlade:
    """Read the blade that a study built; raises an OSError, with its name, if it cannot be computed with."""
    try:
        return _valid(path, *hdf5.read(path))
    except ValueError as error:
        raise DamagedFile(str(error)) from error


def read_valid_blade(path: str | Path) -> ReducedBlade:
    """Read a reduced blade that people may have edited, or other programs written, and check it.

    Raises an OSError if the file is missing, unreadable or not a reduced blade, a ValueError if no runs can
    be computed with it; the messages name the file and the dataset.
    """
    if os.path.exists(path) and not os.path.isfile(path):
        kind = "a folder" if os.path.isdir(path) else "not a regular file"
        raise OSError(f"{path}: is {kind}, must be a reduced blade (HDF5)")
    if h5py.is_hdf5(path):  # what would not fit into memory is not read
        with hdf5.opened(path) as file:
            sizes = {name: getattr(entry, "shape", None) for name, entry in file.items()}
        for name, shape in sizes.items():
            if shape is None or max(shape, default=0) > LARGEST_MATRIX:
                raise ValueError(f"{path}: not a reduced blade, {name} has the shape {shape}")
    return _valid(path, *hdf5.read_any(path))


def _valid(path: str | Path, data: Mapping[str, np.ndarray], attributes: Mapping[str, Any]) -> ReducedBlade:
    try:
        blade = reduced_blade(data, attributes)
        _check(blade)
    except KeyError as error:
        raise DamagedFile(f"{path}: not a reduced blade, {error} is missing") from error
    except ValueError as error:
        raise ValueError(f"{path}: not a valid reduced blade, {error}") from error
    return blade


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
        if name == "node_position" and np.abs(values).max() > FARTHEST:
            raise ValueError(f"{name}: must be within {FARTHEST:g} m of the axis")
        tolerance = 1e-6 * np.abs(values).max()
        if is_matrix and not np.allclose(values, values.T, rtol=0, atol=tolerance):
            raise ValueError(f"{name}: must be symmetric")
    if abs(np.sign(np.diff(blade.node_position[:, 0])).sum()) < n_nodes - 1:
        raise ValueError("node_position: must go on along the axis, x, from each node to the next")
    try:
        lower = np.linalg.cholesky(blade.mass)
    except np.linalg.LinAlgError as error:
        raise ValueError("mass: must be positive definite") from error
    # by NumPy: who plans a study reads its blade, and would wait for SciPy
    stiffness = np.linalg.solve(lower, np.linalg.solve(lower, blade.stiffness_0).T)
    lowest = float(in_hertz(np.linalg.eigvalsh(stiffness)[0]))
    if abs(blade.f1_hz - lowest) > SAME_FREQUENCY * lowest:
        raise ValueError(f"f1_hz = {blade.f1_hz:g}: must be the lowest frequency at rest, {lowest:.6g} Hz")
