"""Solutions and lowest modes of sparse symmetric matrices: by their factors, or by those of a close one.

A blade at speed is solved by conjugate gradients, which the factors of its stiffness at rest precondition.
"""

import functools
import os
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import rslab
from scipy import sparse
from scipy.linalg import solve_triangular
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from bladerub.blade.frequencies import in_hertz

Solve = Callable[[np.ndarray], np.ndarray]

MOST_UNKNOWNS = 400_000  # beyond, the factors of the matrices of a blade fill the memory
THREADS = 2  # of RSLAB, whose own choice may be more than there are cores
MOST_ITERATIONS = 40  # after which the preconditioner is too far, and the matrix gets factors of its own
CLOSE = 1e-12  # relative error of the squared frequencies after which one more correction ends the search


def factorise(matrix: sparse.csc_array) -> Solve:
    """Factor `matrix`, symmetric and regular; return what solves for a right-hand side (n,) or (n, k).

    RSLAB does the work: its factors LDLᵀ take half the memory and half the time of SciPy's SuperLU, and are
    the same to the last bit with any number of threads. SuperLU serves a fork of a process that has used
    RSLAB: its threads are not in the fork, which would wait for them for ever. Raises
    numpy.linalg.LinAlgError if the matrix is singular.
    """
    try:
        if _process_of_threads() != os.getpid():
            return splu(matrix).solve
        factors = rslab.ldlt(matrix, threads=THREADS)
    except RuntimeError as error:
        raise np.linalg.LinAlgError(f"sparse factorisation: {error}") from error
    return lambda rhs: factors.solve(rhs) if rhs.ndim == 1 else factors.solve_many(rhs)


@functools.cache
def _process_of_threads() -> int:
    return os.getpid()


def lowest_modes(
    stiffness: sparse.csc_array, mass: sparse.csc_array, n_modes: int, solve: Solve | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Lowest frequencies (n_modes,), Hz, ascending, and their modes (n, n_modes), orthonormal in the mass.

    The mass is positive definite, the stiffness regular; `solve` is by the stiffness, factored here if not
    given. The frequency of an unstable mode is negative, ``-sqrt(-ω²) / 2π``.
    """
    inverse = LinearOperator(stiffness.shape, matvec=solve or factorise(stiffness), dtype=float)
    start = np.random.default_rng(0).standard_normal(stiffness.shape[0])  # reproducible, unlike ARPACK's
    squares, modes = eigsh(stiffness, n_modes, M=mass, sigma=0.0, OPinv=inverse, v0=start)
    order = np.argsort(squares)
    return in_hertz(squares[order]), modes[:, order]


@dataclass
class PreconditionedCG:
    """Solves with a matrix by conjugate gradients, or by its own factors once these do not converge."""

    matrix: sparse.csc_array  # symmetric
    factors: Solve  # by a positive definite matrix close to it: the preconditioner
    tolerance: float = 1e-14  # relative error of a solution, in the norm of that matrix
    _own: Solve | None = field(init=False, default=None)

    def __call__(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for a right-hand side (n,) or several (n, k)."""
        if self._own is None:
            solution = self._by_conjugate_gradients(rhs)
            if solution is not None:
                return solution
            self._own = factorise(self.matrix)
        return self._own(rhs)

    def _by_conjugate_gradients(self, rhs: np.ndarray) -> np.ndarray | None:
        solution = self.factors(rhs)
        residual = rhs - self.matrix @ solution
        goal = self.tolerance**2 * np.sum(rhs * solution, axis=0)
        direction, size_before = 0.0, 1.0
        for _ in range(MOST_ITERATIONS):
            correction = self.factors(residual)
            size = np.sum(residual * correction, axis=0)
            if np.all(size <= goal):
                return solution
            direction = correction + (size / size_before) * direction
            image = self.matrix @ direction
            curvature = np.sum(direction * image, axis=0)
            if not np.all(curvature > 0):  # not positive definite, or a right-hand side of zeros
                return None
            step = size / curvature
            solution = solution + step * direction
            residual = residual - step * image
            size_before = size
        return None

    def lowest_modes(self, mass: sparse.csc_array, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Lowest modes by Davidson's method, as the function `lowest_modes` gives them.

        The search starts from the modes of a close matrix, `start` (n, n_modes). The preconditioned residuals
        of the modes widen the space in which they are sought. A residual times its preconditioned one is the
        error of the squared frequency, to first order.
        """
        n_modes, converged = start.shape[1], False
        empty = np.empty((len(start), 0))
        basis, images, momenta, addition = empty, empty, empty, start
        for _ in range(MOST_ITERATIONS):
            try:
                addition, momentum = _orthonormal(addition, basis, momenta, mass)
            except np.linalg.LinAlgError:  # nothing new in it
                break
            basis, momenta = np.hstack([basis, addition]), np.hstack([momenta, momentum])
            images = np.hstack([images, self.matrix @ addition])
            squares, shares = np.linalg.eigh(basis.T @ images)
            squares, shares = squares[:n_modes], shares[:, :n_modes]
            modes = basis @ shares
            if converged:
                return in_hertz(squares), modes
            residual = images @ shares - (momenta @ shares) * squares
            addition = self.factors(residual)
            unconverged = np.sum(residual * addition, axis=0) > CLOSE * np.abs(squares)
            converged = not unconverged.any()
            if not converged:
                addition = addition[:, unconverged]
        return lowest_modes(self.matrix, mass, n_modes)


def _orthonormal(
    block: np.ndarray, basis: np.ndarray, momenta: np.ndarray, mass: sparse.csc_array
) -> tuple[np.ndarray, np.ndarray]:
    """Return what `block` (n, k) adds to `basis` (n, m), orthonormal in `mass`, and the mass times it.

    `momenta` are the mass times the basis.
    """
    for _ in range(2):  # the second time against the rounding of the first
        block = block - basis @ (momenta.T @ block)
        block = block / np.linalg.norm(block, axis=0)
        momentum = mass @ block
        factor = np.linalg.cholesky(block.T @ momentum)
        block, momentum = (solve_triangular(factor, vectors.T, lower=True).T for vectors in (block, momentum))
    return block, momentum
