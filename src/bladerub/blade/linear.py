"""Factor a sparse symmetric matrix once, solve many times; lowest modes by shift-invert."""

import functools
import os
from collections.abc import Callable

import numpy as np
import rslab
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from bladerub.blade.frequencies import in_hertz

Solve = Callable[[np.ndarray], np.ndarray]

MOST_UNKNOWNS = 400_000  # beyond, the factors of the matrices of a blade fill the memory
THREADS = 2  # of RSLAB, whose own choice may be more than there are cores


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
