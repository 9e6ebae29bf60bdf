"""Factor a sparse symmetric matrix once, solve many times; lowest modes by shift-invert."""

from __future__ import annotations

import importlib.util
import weakref
from collections.abc import Callable

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, SuperLU, eigsh, splu

from bladerub.blade.dissection import nested_dissection

Solve = Callable[[np.ndarray], np.ndarray]

MOST_BY_DEGREE = 30_000
"""Unknowns up to which minimum degree orders them; the default blade is well below."""
MOST_UNKNOWNS = 400_000
"""Beyond which the factors of the matrices of a blade fill the memory."""


def factorise(matrix: sparse.csc_array) -> Solve:
    """Factor `matrix`, symmetric and regular; return what solves for a right-hand side (n,) or (n, k).

    PARDISO does the work when pypardiso is installed, SuperLU otherwise. Beyond `MOST_BY_DEGREE` unknowns
    SuperLU's own order fills the memory, and METIS finds one with a third of the entries.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is singular.
    """
    if importlib.util.find_spec("pypardiso"):
        return _Pardiso(matrix)
    if matrix.shape[0] <= MOST_BY_DEGREE:
        # Minimum degree on A + Aᵀ without pivoting keeps the symmetry: far less fill than COLAMD.
        return _super_lu(matrix, "MMD_AT_PLUS_A").solve
    order = nested_dissection(matrix)
    factors = _super_lu(matrix[order][:, order], "NATURAL")

    def solve(rhs: np.ndarray) -> np.ndarray:
        solution = np.empty_like(rhs)
        solution[order] = factors.solve(rhs[order])
        return solution

    return solve


def _super_lu(matrix: sparse.csc_array, order: str) -> SuperLU:
    try:
        return splu(
            sparse.csc_matrix(matrix),
            permc_spec=order,
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:
        raise np.linalg.LinAlgError(f"sparse factorisation: {error}") from error


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
