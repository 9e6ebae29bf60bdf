"""From mass and stiffness of another program to a blade that can be reduced."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import ArpackError
from scipy.spatial.distance import cdist
from threadpoolctl import threadpool_limits

from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.linear import lowest_modes
from bladerub.blade.mesh import BladeMesh, FreeCoordinates, MeshedBlade, NodeCloud
from bladerub.blade.reduction import fit_speeds
from bladerub.blade.sources import matrix_folder, tip
from bladerub.blade.sources.definite import check_definite, check_held
from bladerub.blade.sources.matrix_folder import FIT, MASS, NODES
from bladerub.blade.sources.origin import MATRIX_UNITS, MatrixSource
from bladerub.io.errors import BadInput

OMEGA_TOLERANCE = 1e-3  # relative, of the speed of the files to that of the config


@dataclass(frozen=True)
class ImportedMatrices:
    """A blade from the matrices of another program.

    Its length is that from the clamped nodes to the tip or, where no node is clamped, the range of the radii.
    """

    blade: DiscreteBlade
    mass: float  # of the rigid blade, kg
    mass_is_complete: bool  # whether the files have rows of the clamped nodes, whose mass is missing else
    half_speed_change: float  # of the stiffness to half the highest speed, over that to the highest; ~ 1/4
    lean: float  # as in `bladerub.blade.sources.importing.Imported`, rad

    @property
    def is_rooted(self) -> bool:
        """Whether clamped nodes are listed, so that the length is known."""
        return self.blade.layout.mesh.root.size > 0


@threadpool_limits.wrap(limits=1)
def import_matrices(source: MatrixSource, f_max: float, n_modes: int, eta: int) -> ImportedMatrices:
    """Read the matrices of `source` and check that they are of a blade.

    `f_max` is the normalised speed of ``stiffness_max``. There must be coordinates enough for `n_modes` modes
    at rest and for `eta` modes with a clamped interface. A BadInput names the file and what is wrong in it.
    """
    with _naming(source.folder):
        names = matrix_folder.files(source.folder)
        at_speeds = matrix_folder.speeds(names, fit_speeds(f_max))
    with _naming(names["nodes"]):
        nodes = matrix_folder.read_nodes(names["nodes"])
        layout = _layout(nodes, source)
        free = FreeCoordinates(len(nodes.points), nodes.clamped)
        n_internal, wanted = free.free.size - 3 * nodes.interface.size, max(n_modes, eta)
        if n_internal <= wanted:
            raise ValueError(
                f"has {n_internal} free coordinates off the interface; must have more than {wanted}, the "
                "modes that are wanted"
            )
    with _naming(names[MASS]):
        mass_of_all = matrix_folder.read_matrix(names[MASS])
        mass = _of_free(mass_of_all, free, source)
    stiffness = {}
    for f_omega, name in at_speeds.items():
        with _naming(names[name]):
            stiffness[f_omega] = _of_free(matrix_folder.read_matrix(names[name]), free, source)
    rest, half, highest = (stiffness[f_omega] for f_omega in fit_speeds(f_max))
    with _naming(names[MASS]):
        check_definite(mass)
    with _naming(names[FIT[0]]):
        check_definite(rest)
        try:
            frequency, modes = lowest_modes(rest, mass, n_modes)
        except (np.linalg.LinAlgError, ArpackError) as error:
            raise ValueError(f"is singular ({error}); are the clamped nodes marked?") from error
        check_held(rest, modes[:, 0])
    _check_speed(source, f_max, frequency[0])
    change = sparse.linalg.norm(highest - rest)
    middle = layout.mesh.mesh.points.mean(axis=0)
    frequencies = {
        f_omega: lowest_modes(matrix, mass, n_modes)[0] if f_omega > 0 else frequency
        for f_omega, matrix in stiffness.items()
    }
    return ImportedMatrices(
        DiscreteBlade(layout, free, mass, stiffness, {}, frequencies, frequency, modes),
        MATRIX_UNITS[source.matrix_units] * _rigid_mass(mass_of_all),
        nodes.clamped.size > 0 and mass_of_all.shape[0] == 3 * len(nodes.points),
        float(sparse.linalg.norm(half - rest) / change) if change else 0.0,
        float(np.arctan2(middle[1], middle[2])),
    )


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Add `path` to the message of a ValueError."""
    try:
        yield
    except ValueError as error:
        raise BadInput(f"{path}: {error}") from error


def _layout(nodes: matrix_folder.Nodes, source: MatrixSource) -> MeshedBlade:
    """Convert the nodes to the blade's frame, and check that the interface is that of a tip."""
    points = source.frame.metres(nodes.points)
    radius = np.hypot(points[:, 1], points[:, 2])
    ends = points[nodes.interface]
    if radius[nodes.interface].min() <= 0:
        raise ValueError("an interface node lies on the engine axis, which must pass through the origin")
    twins = np.argwhere(np.triu(cdist(ends, ends) == 0, k=1))
    if len(twins):
        first, second = twins[0] + 1
        raise ValueError(f"interface nodes {first} and {second} are in one place")
    if source.frame.downstream_x * (ends[-1, 0] - ends[0, 0]) <= 0:
        raise ValueError(
            f"interface node 1 is downstream of node {len(ends)}; must be at the leading edge: is downstream "
            f"= {source.frame.downstream} the direction of the flow?"
        )
    tip_nodes = nodes.tip if nodes.tip.size else nodes.interface
    lowest = radius[nodes.clamped].mean() if nodes.clamped.size else radius.min()
    length = float(radius[tip_nodes].mean() - lowest)
    if nodes.clamped.size:
        if length <= 0:
            raise ValueError(f"the tip is no farther from the engine axis than the root ({length:.3g} m)")
        source.frame.check_length(length)
    tip_cone = tip.cone(points[tip_nodes], source.tip_cone, source.frame.downstream_x)
    mesh = BladeMesh(NodeCloud(points), nodes.clamped, tip_nodes, nodes.interface)
    return MeshedBlade(mesh, tip_cone, length)


def _of_free(matrix: sparse.csc_array, free: FreeCoordinates, source: MatrixSource) -> sparse.csc_array:
    """Rows and columns of the free coordinates in `matrix`, in the blade's axes and SI units."""
    n, n_all = free.free.size, 3 * free.n_nodes
    if matrix.shape[0] not in (n, n_all):
        raise ValueError(
            f"is {matrix.shape[0]} x {matrix.shape[0]}; must have three rows for each of the {free.n_nodes} "
            f"nodes of {NODES} ({n_all})" + (f", or for each that is not clamped ({n})" if n < n_all else "")
        )
    if matrix.shape[0] > n:
        matrix = matrix[free.free][:, free.free]
    rotation = sparse.kron(sparse.eye_array(n // 3), source.frame.turn, format="csc")
    return sparse.csc_array(MATRIX_UNITS[source.matrix_units] * (rotation @ matrix @ rotation.T))


def _rigid_mass(mass: sparse.csc_array) -> float:
    """Mass of the rigid body, the mean of the three directions."""
    rigid = np.tile(np.eye(3), (mass.shape[0] // 3, 1))
    return float(np.trace(rigid.T @ (mass @ rigid)) / 3)


def _check_speed(source: MatrixSource, f_max: float, f1_hz: float) -> None:
    omega = 2 * np.pi * f1_hz * f_max
    if source.omega_max is not None and abs(source.omega_max / omega - 1) > OMEGA_TOLERANCE:
        right = source.omega_max / (2 * np.pi * f1_hz)
        raise BadInput(
            f"{source.folder}: omega_max = {source.omega_max:g} rad/s is {right:.6g} of the blade's first "
            f"frequency, {f1_hz:.6g} Hz; reduction.f_omega_max = {f_max:g} must be that"
        )
