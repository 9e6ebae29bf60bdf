"""Frequencies of the rotating Euler-Bernoulli beam by a Rayleigh-Ritz method."""

import numpy as np
from numpy.polynomial import Legendre, Polynomial
from scipy.linalg import eigh


def ritz(speed, hub_radius=0.0, n_terms=16):
    """Flapwise frequencies of the rotating Euler-Bernoulli beam, dimensionless.

    Minimises ∫ w″² + T w′² over ∫ w² with T = η² (δ (1 − x) + (1 − x²) / 2), hub radius δ L, in x² times the
    Legendre polynomials on [0, 1]; integrated exactly by Gauss's rule.
    """
    x, weight = np.polynomial.legendre.leggauss(n_terms + 4)
    x, weight = (x + 1) / 2, weight / 2
    clamped = Polynomial([0.0, 0.0, 1.0], [0, 1], [0, 1]).convert(kind=Legendre, domain=[0, 1])
    shapes = [clamped * Legendre.basis(k, [0, 1]) for k in range(n_terms)]
    w, slope, bend = (np.array([shape.deriv(order)(x) for shape in shapes]) for order in (0, 1, 2))
    tension = speed**2 * (hub_radius * (1 - x) + (1 - x**2) / 2)
    stiffness = (bend * weight) @ bend.T + (slope * weight * tension) @ slope.T
    return np.sqrt(eigh(stiffness, (w * weight) @ w.T, eigvals_only=True))
