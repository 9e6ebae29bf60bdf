"""The rotating blade: static equilibrium under centrifugal load, and the stiffness about it."""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from bladerub.blade.elasticity import Solid
from bladerub.blade.linear import PreconditionedCG, Solve, factorise
from bladerub.io.errors import BadInput

TOLERANCE = 1e-9  # largest residual force accepted, over the norm of the centrifugal load
NEGLIGIBLE = 1e-8  # correction, over the norm of the displacement, after which the next would be rounding
MAX_ITERATIONS = 12  # of Newton's method in one load step
KEEPING = 0.2  # largest ratio of two successive residuals at which the tangent is kept, with factors at rest
CORRECTION = 1e-4  # relative error of such a correction by conjugate gradients; the next removes it
MAX_HALVINGS = 8  # of a load step that failed before giving up


class EquilibriumError(BadInput):
    """Newton's method found no static equilibrium under the centrifugal load."""


@dataclass(frozen=True)
class Equilibrium:
    """Static equilibrium of a solid that rotates about the x axis, without Coriolis forces."""

    omega: float  # angular speed, rad/s
    displacement: np.ndarray  # (n,), free coordinates, from rest, m
    stiffness: sparse.csc_array  # (n, n), N/m: material tangent + stress stiffness − spin softening
    n_iterations: int  # of Newton's method
    n_steps: int  # of the load


def equilibrium(
    solid: Solid, omega: float, start: Equilibrium | None = None, at_rest: Solve | None = None
) -> Equilibrium:
    """Find the equilibrium of `solid` at the angular speed `omega` (rad/s).

    The load acts on the displaced position, ``ρ Ω² (0, y + u_y, z + u_z)``. Load steps go in Ω² from `start`
    (rest if not given) to the target: one step first, halved where Newton's method does not converge. With
    `at_rest`, its factored stiffness at rest, as the preconditioner nothing else is factored. Raises
    EquilibriumError if a step is still without equilibrium after `MAX_HALVINGS` halvings.
    """
    target = omega**2
    level, u = (start.omega**2, start.displacement) if start else (0.0, np.zeros(solid.free.size))
    # a tangent is expensive: the first is known, except for the spin softening
    start_stiffness = start.stiffness if start and at_rest else None
    step, smallest = target - level, abs(target - level) / 2**MAX_HALVINGS
    n_iterations = n_steps = 0
    while level != target:
        aim = target if abs(target - level) <= abs(step) else level + step
        tangent = None if start_stiffness is None else _softened(solid, start_stiffness, aim - level)
        solution, iterations = _newton(solid, aim, u, at_rest, tangent)
        n_iterations += iterations
        if solution is not None:
            level, u, start_stiffness = aim, solution, None
            n_steps += 1
        elif abs(step) / 2 < smallest:
            raise EquilibriumError(
                f"no static equilibrium at {omega:.6g} rad/s: Newton's method stops converging above "
                f"{np.sqrt(level):.6g} rad/s, with load steps of {abs(step):.3g} rad²/s²"
            )
        else:
            step /= 2
    return Equilibrium(omega, u, rotating_stiffness(solid, u, target), n_iterations, n_steps)


def rotating_stiffness(solid: Solid, u: np.ndarray, omega_squared: float) -> sparse.csc_array:
    """Evaluate the derivative (n, n) of `residual` at `u`, N/m; the spin softening acts on y and z."""
    return _softened(solid, solid.tangent(u), omega_squared)


def _softened(solid: Solid, stiffness: sparse.csc_array, omega_squared: float) -> sparse.csc_array:
    values = -omega_squared * solid.spinning_mass
    values += stiffness.data
    return sparse.csc_array((values, stiffness.indices, stiffness.indptr), shape=stiffness.shape)


def centrifugal_load(solid: Solid, u: np.ndarray, omega_squared: float) -> np.ndarray:
    """Evaluate the centrifugal force (n,) on the body displaced by `u`, N."""
    return omega_squared * (solid.axis != 0) * (solid.first_moment + solid.mass @ u)


def residual(solid: Solid, u: np.ndarray, omega_squared: float) -> np.ndarray:
    """Subtract the centrifugal load from the internal force (n,), N: zero in equilibrium."""
    return solid.internal_force(u) - centrifugal_load(solid, u, omega_squared)


def _newton(
    solid: Solid, omega_squared: float, u: np.ndarray, at_rest: Solve | None, tangent: sparse.csc_array | None
) -> tuple[np.ndarray | None, int]:
    """Displacement in equilibrium, or None, and the iterations made.

    With factors `at_rest` a tangent, the first perhaps given, is kept while the residual decreases fast.
    """
    solve, before = None, np.inf
    for iteration in range(MAX_ITERATIONS + 1):
        volume_ratio = np.linalg.det(solid.deformation_gradient(u))
        if not np.all(volume_ratio > 0):  # matter turned inside out, or not finite
            return None, iteration
        force = residual(solid, u, omega_squared)
        scale = np.linalg.norm(centrifugal_load(solid, u, omega_squared))
        size = np.linalg.norm(force)
        if size <= TOLERANCE * scale:
            return u, iteration
        if iteration == MAX_ITERATIONS:
            break
        if at_rest is None or size > KEEPING * before:
            solve = None  # frees the memory before there is a new one
        before = size
        try:
            if solve is None:
                tangent = rotating_stiffness(solid, u, omega_squared) if tangent is None else tangent
                solve = PreconditionedCG(tangent, at_rest, CORRECTION) if at_rest else factorise(tangent)
                tangent = None
            correction = solve(force)
        except np.linalg.LinAlgError:
            return None, iteration
        u = u - correction
        # a slow blade strains so little that the rounding of its forces exceeds what TOLERANCE allows
        if np.linalg.norm(correction) <= NEGLIGIBLE * np.linalg.norm(u):
            return u, iteration + 1
    return None, MAX_ITERATIONS
