"""Factor a sparse symmetric matrix once, solve many times; lowest modes by shift-invert."""

from __future__ import annotations

import importlib.util
import weakref
from collections.abc import Callable

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

Solve = Callable[[np.ndarray], np.ndarray]


def factorise(matrix: sparse.csc_array) -> Solve:
    """Factor `matrix`, symmetric and regular; return what solves for a right-hand side (n,) or (n, k).

    PARDISO does the work when pypardiso is installed, SuperLU otherwise.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is singular.
    """
    if importlib.util.find_spec("pypardiso"):
        return _Pardiso(matrix)
    try:
        # Minimum degree on A + Aᵀ without pivoting keeps the symmetry: far less fill than COLAMD.
        factors = splu(
            sparse.csc_matrix(matrix),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:
        raise np.linalg.LinAlgError(f"sparse factorisation: {error}") from error
    return factors.solve


class _Pardiso:
    """Factors kept by PARDISO, whose memory outlives Python's objects unless it is told."""

    def __init__(self, matrix: sparse.csc_array):
        from pypardiso import PyPardisoSolver
        from pypardiso.pardiso_wrapper import PyPardisoError

        self._matrix = sparse.csr_matrix(matrix)
        self._solver = PyPardisoSolver()
        weakref.finalize(self, self._solver.free_memory, everything=True)
        try:
            self._solver.factorize(self._matrix)
        except (ValueError, PyPardisoError) as error:
            raise np.linalg.LinAlgError(f"sparse factorisation: {error}") from error

    def __call__(self, rhs: np.ndarray) -> np.ndarray:
        return self._solver.solve(self._matrix, rhs)


def lowest_modes(
    stiffness: sparse.csc_array, mass: sparse.csc_array, n_modes: int, solve: Solve | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Lowest modes of a clamped body.

    Parameters
    ----------
    stiffness, mass : (n, n) sparse array
        Both symmetric, the mass positive definite, the stiffness regular.
    n_modes : int
        How many.
    solve : callable, optional
        The factored stiffness, where it is there already.

    Returns
    -------
    frequencies : (n_modes,) ndarray
        Hz, ascending; negative for an unstable mode (``-sqrt(-ω²) / 2π``).
    modes : (n, n_modes) ndarray
        Columns orthonormal in the mass.
    """
    inverse = LinearOperator(stiffness.shape, matvec=solve or factorise(stiffness), dtype=float)
    start = np.random.default_rng(0).standard_normal(
        stiffness.shape[0]
    )  # the same every time, unlike ARPACK's
    squares, modes = eigsh(stiffness, n_modes, M=mass, sigma=0.0, OPinv=inverse, v0=start)
    order = np.argsort(squares)
    return np.sign(squares[order]) * np.sqrt(np.abs(squares[order])) / (2 * np.pi), modes[:, order]
