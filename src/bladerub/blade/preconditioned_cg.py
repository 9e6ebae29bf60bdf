"""Preconditioned conjugate gradients for a blade at speed, by the factors of its stiffness at rest."""

from dataclasses import dataclass, field

import numpy as np
from scipy import sparse
from scipy.linalg import solve_triangular

from bladerub.blade import linear
from bladerub.blade.frequencies import in_hertz
from bladerub.blade.linear import Solve

MOST_ITERATIONS = 40  # after which the preconditioner is too far, and the matrix gets factors of its own
CLOSE = 1e-12  # relative error of the squared frequencies after which one more correction ends the search


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
            self._own = linear.factorise(self.matrix)
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
        """Lowest modes by Davidson's method, as `bladerub.blade.linear.lowest_modes` gives them.

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
        return linear.lowest_modes(self.matrix, mass, n_modes)


def _orthonormal(
    block: np.ndarray, basis: np.ndarray, momenta: np.ndarray, mass: sparse.csc_array
) -> tuple[np.ndarray, np.ndarray]:
    """Make what `block` (n, k) adds to the orthonormal `basis` (n, m) orthonormal in `mass`, too.

    `momenta` are the mass times the basis. Returns the addition and the mass times it.
    """
    for _ in range(2):  # the second time against the rounding of the first
        block = block - basis @ (momenta.T @ block)
        block = block / np.linalg.norm(block, axis=0)
        momentum = mass @ block
        factor = np.linalg.cholesky(block.T @ momentum)
        block, momentum = (solve_triangular(factor, vectors.T, lower=True).T for vectors in (block, momentum))
    return block, momentum
