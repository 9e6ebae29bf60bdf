"""Matrices for other programs: of the reduced blade, and of its finite elements."""

from pathlib import Path

import numpy as np
import pandas as pd
from scipy import sparse
from scipy.io import mmwrite, savemat

from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.model import ReducedBlade
from bladerub.blade.reduction import fit_speeds
from bladerub.extras.blades.matrix_folder import AT_SPEED, FIT, MASS, NODES
from bladerub.io import atomic

_DIGITS = 17  # enough to restore every bit


def write_matrices(path: str | Path, blade: ReducedBlade) -> None:
    """Write the fields of `ReducedBlade` under their own names; `path` ends in ``.npz`` or ``.mat``."""
    content = blade.arrays | blade.attributes
    with atomic.writing(path, "wb") as file:
        if Path(path).suffix.lower() == ".npz":
            np.savez_compressed(file, **content)
        else:
            savemat(file, content, do_compression=True, oned_as="column")


def write_fe_matrices(folder: str | Path, blade: DiscreteBlade, f_max: float, suffix: str) -> list[Path]:
    """Write mass and stiffness of the free coordinates, in SI units, and then the list of nodes.

    The folder is what `bladerub import` reads. `f_max` is the highest normalised speed of the fit, `suffix`
    ``.mtx`` (Matrix Market) or ``.npz`` (of `scipy.sparse`).
    """
    names = dict(zip(fit_speeds(f_max), FIT, strict=True))
    matrices = {MASS: blade.mass} | {
        names.get(f_omega, f"{AT_SPEED}{f_omega:.10g}"): matrix for f_omega, matrix in blade.stiffness.items()
    }
    paths = {Path(folder) / f"{name}{suffix}": matrix for name, matrix in matrices.items()}
    for path, matrix in paths.items():
        with atomic.writing(path, "wb") as stream:
            if suffix == ".mtx":
                mmwrite(stream, matrix, precision=_DIGITS, symmetry="symmetric")
            else:
                sparse.save_npz(stream, matrix)
    nodes = Path(folder) / NODES
    with atomic.writing(nodes) as stream:
        _node_list(blade.layout.mesh).to_csv(stream, index=False, float_format=f"%.{_DIGITS}g")
    return [*paths, nodes]


def _node_list(mesh: BladeMesh) -> pd.DataFrame:
    table = pd.DataFrame(mesh.mesh.points, columns=["x", "y", "z"]).assign(interface=0, clamped=0, tip=0)
    table.loc[mesh.interface, "interface"] = np.arange(1, mesh.interface.size + 1)
    table.loc[mesh.root, "clamped"] = 1
    table.loc[mesh.tip, "tip"] = 1
    return table
