"""The blade as matrices over its free coordinates: all that the reduction needs to know of it."""

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy import sparse
from threadpoolctl import threadpool_limits

from bladerub.blade.elasticity import Solid
from bladerub.blade.linear import PreconditionedCG, Solve, factorise, lowest_modes
from bladerub.blade.mesh import FreeCoordinates, MeshedBlade
from bladerub.blade.rotation import equilibrium
from bladerub.settings.blade import Material

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class DiscreteBlade:
    """Small motions of a blade about its equilibrium at several normalised speeds.

    `at_rest` is not there for a blade given by matrices: the factored stiffness at rest preconditions the
    solutions at speed (`bladerub.blade.linear`), where `stiffness` then has the same pattern.
    """

    layout: MeshedBlade
    free: FreeCoordinates  # the nodes' coordinates that the matrices are of
    mass: sparse.csc_array = field(repr=False)  # (n, n), kg
    stiffness: Mapping[float, sparse.csc_array] = field(repr=False)  # (n, n), N/m; few, as they are large
    displacement: Mapping[float, np.ndarray] = field(repr=False)  # (n,), from rest, m, where known
    frequencies: Mapping[float, np.ndarray]  # (n_modes,), Hz, ascending speeds, for the accuracy table
    frequency: np.ndarray  # (n_modes,), at rest, Hz; the first is the unit of normalised speeds
    modes: np.ndarray = field(repr=False)  # (n, n_modes), at rest
    at_rest: Solve | None = field(repr=False, default=None)
    modes_at_speed: Mapping[float, np.ndarray] = field(repr=False, default_factory=dict)  # of `frequencies`


@threadpool_limits.wrap(limits=1)
def by_finite_elements(
    blade: MeshedBlade,
    material: Material,
    speeds: Sequence[float],
    table_speeds: Sequence[float],
    n_modes: int,
) -> DiscreteBlade:
    """Discretise `blade`, clamped at its root, by the finite elements of its mesh.

    It runs in one thread: the last digit of sums depends on the number of threads, and another blade makes
    all its runs stale. The stiffness is kept at the normalised `speeds`, the first `n_modes` frequencies are
    found at the ascending `table_speeds`. Raises EquilibriumError if there is no equilibrium at one of them.
    """
    mesh = blade.mesh.mesh
    solid = Solid(mesh, material, clamped=blade.mesh.root)
    log.info("%d elements, %d free coordinates", len(mesh.cells), solid.free.size)
    state = equilibrium(solid, 0.0)
    at_rest = factorise(state.stiffness)
    frequency, modes = lowest_modes(state.stiffness, solid.mass, n_modes, at_rest)
    unit = 2 * np.pi * frequency[0]  # rad/s
    stiffness, displacement, frequencies, shapes = {}, {}, {}, {0.0: modes}
    for f_omega in sorted({0.0, *speeds, *table_speeds}):
        if f_omega > 0:
            state = equilibrium(solid, f_omega * unit, state, at_rest)
            moved = 1e3 * np.linalg.norm(solid.full(state.displacement), axis=1).max()
            summary = f"equilibrium in {state.n_steps} load steps, {state.n_iterations} iterations"
            log.info("f_omega = %.4f: %s, largest displacement %.4g mm", f_omega, summary, moved)
        displacement[f_omega] = state.displacement
        if f_omega in speeds:
            stiffness[f_omega] = state.stiffness
        if f_omega in table_speeds:
            if f_omega == 0:
                frequencies[f_omega] = frequency
            else:
                nearest = shapes[max(shapes)]
                solver = PreconditionedCG(state.stiffness, at_rest)
                frequencies[f_omega], shapes[f_omega] = solver.lowest_modes(solid.mass, nearest)
            log.info("f_omega = %.4f: first frequency %.4f Hz", f_omega, frequencies[f_omega][0])
    free = FreeCoordinates(solid.n_nodes, blade.mesh.root)
    return DiscreteBlade(
        blade, free, solid.mass, stiffness, displacement, frequencies, frequency, modes, at_rest, shapes
    )
