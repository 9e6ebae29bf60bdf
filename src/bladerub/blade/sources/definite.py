"""Checks that mass and stiffness are those of a clamped body with a stable equilibrium."""

import numpy as np
from scipy import sparse
from scipy.linalg import eigvalsh_tridiagonal

_STEPS = 60
_ROUNDING = 1e-10  # of the largest eigenvalue
_ENERGY = 1e-13  # of what would be there if nothing cancelled; 1e-8 in the first mode of a thin blade


def check_definite(matrix: sparse.csc_array) -> None:
    """Raise ValueError if a symmetric matrix has an entry on its diagonal or an eigenvalue below zero.

    Ritz values of Lanczos's method lie between the eigenvalues, so a negative one is proof. Eigenvalues near
    zero may stay unnoticed (see `check_held` for these).
    """
    diagonal = matrix.diagonal()
    low = np.flatnonzero(diagonal <= 0)
    if low.size:
        raise ValueError(
            f"is not positive definite: its entry ({low[0] + 1}, {low[0] + 1}) is {diagonal[low[0]]:.3g}; "
            "must be above 0"
        )
    scale = 1 / np.sqrt(diagonal)
    ritz = _ritz_values(lambda vector: scale * (matrix @ (scale * vector)), diagonal.size)
    if ritz.min() < -_ROUNDING * np.abs(ritz).max():
        raise ValueError("is not positive definite: it has negative eigenvalues")


def _ritz_values(product, n: int) -> np.ndarray:
    vector = np.random.default_rng(0).standard_normal(n)
    vector /= np.linalg.norm(vector)
    before, beta = np.zeros(n), 0.0
    alphas, betas = [], []
    for _ in range(min(_STEPS, n)):
        after = product(vector) - beta * before
        alphas.append(after @ vector)
        after -= alphas[-1] * vector
        beta = np.linalg.norm(after)
        betas.append(beta)
        if beta <= _ROUNDING * abs(alphas[0]):
            break
        before, vector = vector, after / beta
    return eigvalsh_tridiagonal(np.array(alphas), np.array(betas[:-1]))


def check_held(stiffness: sparse.csc_array, mode: np.ndarray) -> None:
    """Raise ValueError if the energy of the lowest `mode` of a stiffness is negative or only rounding."""
    size = np.abs(mode)
    if mode @ (stiffness @ mode) <= _ENERGY * (size @ (abs(stiffness) @ size)):
        raise ValueError(
            "is singular or indefinite: its lowest mode moves the blade without resistance; mark the clamped "
            "nodes, or leave their rows out"
        )
