"""The blade's finite element matrices, as a folder that `bladerub import` reads again."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import sparse
from scipy.io import mmwrite

from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.reduction import fit_speeds
from bladerub.blade.sources.matrix_folder import AT_SPEED, FIT, MASS, NODES
from bladerub.io import atomic

_DIGITS = 17  # with which a number comes back as it was


def write_fe_matrices(folder: str | Path, blade: DiscreteBlade, f_max: float, suffix: str) -> list[Path]:
    """Write mass and stiffness of the free coordinates, in SI units, and the list of nodes, which comes last.

    Parameters
    ----------
    folder : path-like
        Is made if need be.
    blade : DiscreteBlade
        The blade.
    f_max : float
        Highest speed of the fit, normalised; stiffness at other speeds than those of the fit is written too.
    suffix : {".mtx", ".npz"}
        Matrix Market, or what `scipy.sparse.load_npz` reads.
    """
    names = dict(zip(fit_speeds(f_max), FIT, strict=True))
    matrices = {MASS: blade.mass} | {
        names.get(f_omega, f"{AT_SPEED}{f_omega:.10g}"): matrix for f_omega, matrix in blade.stiffness.items()
    }
    paths = [_write_matrix(Path(folder) / f"{name}{suffix}", matrix) for name, matrix in matrices.items()]
    nodes = Path(folder) / NODES
    with atomic.writing(nodes) as stream:
        _node_list(blade.layout.mesh).to_csv(stream, index=False, float_format="%.17g")
    return [*paths, nodes]


def _write_matrix(path: Path, matrix: sparse.csc_array) -> Path:
    with atomic.writing(path, "wb") as stream:
        if path.suffix == ".mtx":
            mmwrite(stream, matrix, precision=_DIGITS, symmetry="symmetric")
        else:
            sparse.save_npz(stream, matrix)
    return path


def _node_list(mesh: BladeMesh) -> pd.DataFrame:
    points = mesh.mesh.points
    marks: Mapping[str, np.ndarray] = {
        name: np.zeros(len(points), dtype=int) for name in ("interface", "clamped", "tip")
    }
    marks["interface"][mesh.interface] = np.arange(1, mesh.interface.size + 1)
    marks["clamped"][mesh.root] = 1
    marks["tip"][mesh.tip] = 1
    return pd.DataFrame(points, columns=["x", "y", "z"]).assign(**marks)
