"""The reduction of a discretised blade, with more fit speeds and modes where a tolerance asks for them."""

import logging
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import blas
from threadpoolctl import threadpool_limits

from bladerub.blade.accuracy import MODES, accuracy_table, errors_by_mode
from bladerub.blade.built import BuiltBlade
from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.linear import lowest_modes
from bladerub.blade.model import ReducedBlade, stiffness_at
from bladerub.blade.preconditioned_cg import PreconditionedCG
from bladerub.blade.reduction import Partition, fit_speeds, project, speed_law, transformation
from bladerub.blade.tip_slope import tip_slope
from bladerub.io.errors import BadInput

log = logging.getLogger(__name__)

MOST_FIT_SPEEDS = 7
MOST_MODES_PER_SPEED = 30


def reduce_to_tolerance(
    discrete: Callable[[int], DiscreteBlade], config: Mapping[str, Any], made_from: str, most_fit_speeds: int
) -> BuiltBlade:
    """Reduce the blade that `discrete` gives for a number of fit speeds, at most `most_fit_speeds`.

    Where the config has a ``reduction.tolerance``, the largest relative error of the first `MODES`
    frequencies at the accuracy speeds must be below it. While eq. (2) alone has more than half of what is
    allowed, one fit speed is added, else two modes at each speed. If that is not enough, a BadInput states
    the error that is reached.
    """
    reduction, length = dict(config["reduction"]), config["blade"]["length"]
    tolerance = reduction.get("tolerance")
    while True:
        n_speeds, n_modes = reduction.get("fit_speeds", 3), reduction["modes_per_speed"]
        built = _reduce(discrete(n_speeds), reduction, length, made_from)
        if tolerance is None:
            return built
        errors = errors_by_mode(built.accuracy)[:MODES].max()
        log.info("%d fit speeds, %d modes at each: error %.3g", n_speeds, n_modes, errors.reduced_model)
        if errors.reduced_model <= tolerance:
            return built
        if errors.speed_law > tolerance / 2 and n_speeds < most_fit_speeds:
            reduction["fit_speeds"] = n_speeds + 1
        elif n_modes < MOST_MODES_PER_SPEED:
            reduction["modes_per_speed"] = n_modes + 2
        else:
            raise BadInput(
                f"reduction.tolerance = {tolerance:g}: the reduced model comes to "
                f"{errors.reduced_model:.2g} with {n_speeds} fit speeds and {n_modes} modes at each (eq. (2) "
                f"alone to {errors.speed_law:.2g}); must be more, or lower reduction.f_omega_max or "
                "reduction.rank_tolerance"
            )


@threadpool_limits.wrap(limits=1)  # as `by_finite_elements`
def _reduce(blade: DiscreteBlade, reduction: Mapping[str, Any], length: float, made_from: str) -> BuiltBlade:
    """Reduce `blade` once, as a ``reduction`` block of the config says."""
    mesh, full = blade.layout.mesh, blade.free.full
    f_max = reduction["f_omega_max"]

    partition = Partition.around(blade.free.coordinates(mesh.interface), blade.mass.shape[0])
    fits = [blade.stiffness[f_omega] for f_omega in fit_speeds(f_max, reduction.get("fit_speeds", 3))]
    eta, rank_tolerance = reduction["modes_per_speed"], reduction["rank_tolerance"]
    phi = transformation(fits, blade.mass, partition, eta, rank_tolerance, blade.at_rest)
    recovery = np.stack([full(column) for column in phi.T])  # eq. (6)
    radial, tangential = directions(mesh.mesh.points[mesh.interface], blade.layout.tip_cone)
    k0, k1, k2, *higher = speed_law([project(stiffness, phi) for stiffness in fits], f_max)  # eqs. (3), (6)
    reduced = ReducedBlade(
        project(blade.mass, phi),  # eq. (6)
        k0,
        k1,
        k2,
        node_position=mesh.mesh.points[mesh.interface],
        radial_direction=radial,
        tangential_direction=tangential,
        f1_hz=float(blade.frequency[0]),
        f_omega_max=f_max,
        eta=eta,
        rank_tolerance=rank_tolerance,
        length=length,
        stiffness_higher=tuple(higher),
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
        made_from,
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
