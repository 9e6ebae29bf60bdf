"""The reduced blade's matrices for other programs: NumPy and MATLAB."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import numpy as np
from scipy.io import savemat

from bladerub.blade.model import ReducedBlade
from bladerub.io import atomic

SUFFIXES = (".npz", ".mat")


def write_matrices(path: str | Path, blade: ReducedBlade) -> None:
    """Write all that `ReducedBlade` holds under its own names, as the suffix of `path` says.

    Raises
    ------
    ValueError
        If the suffix is neither ``.npz`` nor ``.mat``.
    """
    path = Path(path)
    if path.suffix.lower() not in SUFFIXES:
        raise ValueError(f"{path}: must end in {' or '.join(SUFFIXES)}")
    content = asdict(blade) | blade.arrays
    del content["stiffness_higher"]
    with atomic.writing(path, "wb") as file:
        if path.suffix.lower() == ".npz":
            np.savez_compressed(file, **content)
        else:
            savemat(file, content, do_compression=True, oned_as="column")
