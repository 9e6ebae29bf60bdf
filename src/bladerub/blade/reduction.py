"""Craig-Bampton reduction with centrifugal stiffening, eqs. (2) to (6)."""

import logging
from collections.abc import Sequence

import numpy as np
from scipy import sparse
from scipy.linalg import blas
from threadpoolctl import threadpool_limits

from bladerub.blade.built import BuiltBlade
from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.files import made_from
from bladerub.blade.frequencies import accuracy_table, reduced_frequencies
from bladerub.blade.linear import PreconditionedCG, Solve, factorise, lowest_modes
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.model import ReducedBlade, stiffness_at
from bladerub.settings.blade import BladeSpec

log = logging.getLogger(__name__)

REACH = 0.6
"""Distance to which nodes of the tip count in its slope, in distances of interface nodes: over the whole
thickness."""


def fit_speeds(f_max: float, count: int = 3) -> list[float]:
    """Give the normalised speeds whose stiffness the coefficients of eq. (2) are fitted to."""
    return [f_max * index / (count - 1) for index in range(count)]


def speed_law(fits: Sequence, f_max: float) -> tuple:
    """Coefficients K⁰, K¹, K² ... of eq. (2) from the stiffness, dense or sparse, at each of `fit_speeds`.

    With the three speeds of the paper this is eq. (3); with more, eq. (2) goes on with the next even powers.
    """
    if len(fits) == 3:
        at_rest, at_half, at_max = fits
        k0 = at_rest  # eq. (3)
        k1 = (16 * at_half - at_max - 15 * at_rest) / (3 * f_max**2)  # eq. (3)
        # eq. (3) is misprinted there: the factor 3 / (4 f_max^4) of the paper does not return K(f_max / 2)
        # and K(f_max); its reciprocal in the numbers, 4 / (3 f_max^4), does.
        k2 = 4 / (3 * f_max**4) * (at_max - 4 * at_half + 3 * at_rest)  # eq. (3), corrected
        return k0, k1, k2
    squares = np.square(fit_speeds(1.0, len(fits)))
    shares = np.linalg.inv(np.vander(squares, increasing=True))  # of each fit in each coefficient
    return tuple(
        sum(share * fit for share, fit in zip(row, fits, strict=True)) / f_max ** (2 * power)
        for power, row in enumerate(shares)
    )


class Partition:
    """The n free coordinates split into those of the interface, u_f, and the internal ones, u_i, eq. (6)."""

    def __init__(self, interface: np.ndarray, n: int):
        self.interface = interface  # places in the free vector, node by node, x, y, z
        self.internal = np.setdiff1d(np.arange(n), interface)


def constraint_modes(stiffness: sparse.csc_array, partition: Partition, solve: Solve) -> np.ndarray:
    """Constraint modes Φ_R (n_internal, n_interface) of eq. (4), static responses; `solve` is by K_ii."""
    coupling = stiffness[partition.internal][:, partition.interface]
    return -solve(coupling.toarray())


def internal_solve(solve: Solve, partition: Partition) -> Solve:
    """Solve by K_ii with the factors of the full K, `solve`: forces on the interface keep it at rest."""
    n, n_interface = partition.interface.size + partition.internal.size, partition.interface.size
    unit_forces = np.zeros((n, n_interface))
    unit_forces[partition.interface, np.arange(n_interface)] = 1
    flexibility = solve(unit_forces)
    unit_displacements = np.linalg.solve(flexibility[partition.interface].T, flexibility.T).T

    def solve_internal(rhs: np.ndarray) -> np.ndarray:
        forces = np.zeros((n, *rhs.shape[1:]))
        forces[partition.internal] = rhs
        moved = solve(forces)
        return (moved - unit_displacements @ moved[partition.interface])[partition.internal]

    return solve_internal


def transformation(
    stiffnesses: Sequence[sparse.csc_array],
    mass: sparse.csc_array,
    partition: Partition,
    eta: int,
    rank_tolerance: float,
    at_rest: Solve | None = None,
) -> np.ndarray:
    """Φ of eq. (5), (n, n_reduced), from the stiffness at the fit speeds, rest first.

    The columns of eq. (4) that belong to the internal coordinates are made orthonormal in the mass (see
    `mass_orthonormal`). `at_rest`, the factored stiffness at rest, is the preconditioner.
    """
    internal = partition.internal
    mass_ii = mass[internal][:, internal]
    preconditioner = at_rest and internal_solve(at_rest, partition)
    constraint, fixed = [], []  # Φ_R and Φ_L of eq. (4)
    for stiffness in stiffnesses:
        stiffness_ii = sparse.csc_array(stiffness[internal][:, internal])
        solve = PreconditionedCG(stiffness_ii, preconditioner) if preconditioner else factorise(stiffness_ii)
        if preconditioner and fixed:
            modes = solve.lowest_modes(mass_ii, fixed[-1])[1]
        else:
            modes = lowest_modes(stiffness_ii, mass_ii, eta, solve)[1]
        constraint.append(constraint_modes(stiffness, partition, solve))
        fixed.append(modes)
        del solve  # frees the memory before there are new factors
    phi_r = constraint[0]
    columns = np.hstack([*(later - phi_r for later in constraint[1:]), *fixed])  # eq. (4)
    psi = mass_orthonormal(columns, mass_ii, rank_tolerance)

    n_interface = partition.interface.size
    phi = np.zeros((mass.shape[0], n_interface + psi.shape[1]))  # eq. (5)
    phi[partition.interface, :n_interface] = np.eye(n_interface)
    phi[internal, :n_interface] = phi_r
    phi[internal, n_interface:] = psi
    return phi


def mass_orthonormal(columns: np.ndarray, mass: sparse.csc_array, rank_tolerance: float) -> np.ndarray:
    """Basis Ψ (n, rank) of the span of `columns` (n, k), orthonormal in `mass`.

    The columns are scaled to unit norm in the mass; singular directions below `rank_tolerance` times the
    largest singular value are dropped.
    """
    columns = columns / np.sqrt(np.sum(columns * (mass @ columns), axis=0))
    squares, directions = np.linalg.eigh(columns.T @ (mass @ columns))
    rank_mask = squares > rank_tolerance**2 * squares[-1]
    psi = columns @ (directions[:, rank_mask] / np.sqrt(squares[rank_mask]))
    # The Gram matrix squares the condition number: once more, for orthonormality to rounding.
    factor = np.linalg.cholesky(psi.T @ (mass @ psi))
    return np.linalg.solve(factor, psi.T).T


def project(matrix: sparse.csc_array, phi: np.ndarray) -> np.ndarray:
    """Φᵀ A Φ, exactly symmetric, of the symmetric matrix A of a model whose u is Φ (u_f, q), eq. (6)."""
    reduced = phi.T @ (matrix @ phi)  # eq. (6)
    return 0.5 * (reduced + reduced.T)


@threadpool_limits.wrap(limits=1)  # as `by_finite_elements`
def reduce(blade: DiscreteBlade, config: BladeSpec) -> BuiltBlade:
    """Reduce `blade` as `config` says; raises as `bladerub.blade.files.made_from`."""
    mesh, full, reduction = blade.layout.mesh, blade.free.full, config.reduction
    f_max = reduction.f_omega_max

    partition = Partition(blade.free.coordinates(mesh.interface), blade.mass.shape[0])
    fits = [blade.stiffness[f_omega] for f_omega in fit_speeds(f_max, reduction.fit_speeds or 3)]
    eta, rank_tolerance = reduction.modes_per_speed, reduction.rank_tolerance
    phi = transformation(fits, blade.mass, partition, eta, rank_tolerance, blade.at_rest)
    recovery = np.stack([full(column) for column in phi.T])  # eq. (6)
    radial, tangential = directions(mesh.mesh.points[mesh.interface], blade.layout.tip_cone)
    coefficients = speed_law([project(stiffness, phi) for stiffness in fits], f_max)  # eqs. (3), (6)
    reduced = ReducedBlade(
        project(blade.mass, phi),  # eq. (6)
        *coefficients[:3],
        node_position=mesh.mesh.points[mesh.interface],
        radial_direction=radial,
        tangential_direction=tangential,
        f1_hz=float(blade.frequency[0]),
        f_omega_max=f_max,
        eta=eta,
        rank_tolerance=rank_tolerance,
        length=config.blade.length,
        stiffness_higher=coefficients[3:],
        tip_slope=tip_slope(mesh, recovery, radial, tangential),
    )
    highest = reduced_frequencies(reduced, f_max)[-1]
    log.info("%d reduced coordinates, highest %.4g Hz", len(reduced.mass), highest)

    shapes = np.stack([full(mode) for mode in blade.modes.T])
    moved = [f_omega for f_omega in blade.frequencies if f_omega in blade.displacement]
    return BuiltBlade(
        reduced,
        mesh,
        blade.frequency,
        shapes / np.abs(shapes).max(axis=(1, 2), keepdims=True),
        recovery,
        np.array([full(blade.displacement[f_omega]) for f_omega in moved]).reshape(-1, *shapes.shape[1:]),
        np.array(moved, dtype=float),
        accuracy_table(reduced, blade.frequencies, _frequencies_by_law(blade, fits, f_max)),
        made_from(config),
    )


def _frequencies_by_law(blade: DiscreteBlade, fits: list, f_max: float) -> dict[float, np.ndarray]:
    """Frequencies (Hz) of the unreduced `blade` with the stiffness of eq. (2), at its accuracy speeds."""
    if blade.at_rest is None:
        coefficients = speed_law(fits, f_max)
        return {
            f_omega: lowest_modes(stiffness_at(coefficients, f_omega), blade.mass, blade.frequency.size)[0]
            for f_omega in blade.frequencies
        }
    shares = speed_law(np.eye(len(fits)), f_max)  # of the fits: coefficients as large would fill the memory
    frequencies = {}
    for f_omega in blade.frequencies:
        values = np.zeros(fits[0].nnz)
        for weight, fit in zip(stiffness_at(shares, f_omega), fits, strict=True):
            values = blas.daxpy(fit.data, values, a=weight)  # in place
        law = sparse.csc_array((values, fits[0].indices, fits[0].indptr), shape=fits[0].shape)
        modes = blade.modes_at_speed[f_omega]
        frequencies[f_omega] = PreconditionedCG(law, blade.at_rest).lowest_modes(blade.mass, modes)[0]
    return frequencies


def directions(position: np.ndarray, tip_cone: float) -> tuple[np.ndarray, np.ndarray]:
    """Give unit vectors (n, 3) out of the flow path and along the rotation at points (n, 3) of the tip.

    The first is radial for a cylindrical flow path; where it widens downstream by `tip_cone` (rad) it leans
    upstream by that angle, as the normal of the casing does.
    """
    phi = np.arctan2(position[:, 1], position[:, 2])
    zero, cone = np.zeros_like(phi), np.full_like(phi, tip_cone)
    radial = np.stack([-np.sin(cone), np.cos(cone) * np.sin(phi), np.cos(cone) * np.cos(phi)], axis=1)
    return radial, np.stack([zero, np.cos(phi), -np.sin(phi)], axis=1)


def tip_slope(
    mesh: BladeMesh, recovery: np.ndarray, radial: np.ndarray, tangential: np.ndarray
) -> np.ndarray | None:
    """Circumferential slope (j, n) of the tip at each interface node, per unit of each coordinate.

    A plane is fitted to the radial displacement of the tip's nodes around, within `REACH`. The slope is that
    of the plane along the casing, positive where the side ahead in the rotation rises. None if some interface
    node has too few neighbours on the tip for a plane. `recovery` (n, n_nodes, 3) is the displacement of the
    nodes per unit of each coordinate; `radial` and `tangential` (j, 3) are the directions at the interface.
    """
    points = mesh.mesh.points
    nodes = points[mesh.interface]
    reach = REACH * np.linalg.norm(np.diff(nodes, axis=0), axis=1).mean()
    slopes = []
    for node, outward, along in zip(nodes, radial, tangential, strict=True):
        offset = points[mesh.tip] - node
        neighbours = np.linalg.norm(offset, axis=1) <= reach
        offset = offset[neighbours]
        plane = np.stack([np.ones(len(offset)), offset @ along, offset @ np.cross(outward, along)], axis=1)
        if np.linalg.matrix_rank(plane, tol=1e-3 * reach) < 3:
            return None
        displacement = recovery[:, mesh.tip[neighbours]] @ outward
        slopes.append(np.linalg.lstsq(plane, displacement.T)[0][1])
    return np.array(slopes)
