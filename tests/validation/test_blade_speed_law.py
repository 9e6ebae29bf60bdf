"""Eqs. (2) and (3) of the paper, and the misprint in the factor of K²."""

import numpy as np
import pytest

from bladerub.blade.model import stiffness_at
from bladerub.blade.reduction import fit_speeds, speed_law

F_MAX = 0.4


def fit_matrices():
    rng = np.random.default_rng(11)
    random = rng.standard_normal((3, 12, 12)) * np.array([1e9, 1e8, 1e8])[:, None, None]
    rest, half, full = random + np.swapaxes(random, 1, 2)
    return rest, rest + half, rest + half + full


def test_eq_2_returns_the_three_fit_matrices():
    fits = fit_matrices()
    coefficients = speed_law(fits, F_MAX)
    for f_omega, expected in zip((0.0, F_MAX / 2, F_MAX), fits, strict=True):
        error = np.abs(stiffness_at(coefficients, f_omega) - expected).max()
        assert error <= 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize("count", [3, 4, 7])
def test_any_number_of_fits_is_met_by_as_many_even_powers(count):
    rng = np.random.default_rng(count)
    terms = [matrix / F_MAX ** (2 * power) for power, matrix in enumerate(rng.standard_normal((count, 6, 6)))]

    def stiffness(f_omega):
        return sum(f_omega ** (2 * power) * term for power, term in enumerate(terms))

    coefficients = speed_law([stiffness(f_omega) for f_omega in fit_speeds(F_MAX, count)], F_MAX)
    assert len(coefficients) == count
    np.testing.assert_allclose(stiffness_at(coefficients, 0.33), stiffness(0.33), atol=1e-10)
