"""Eqs. (2) and (3) of the paper, and the misprint in the factor of K²."""

import numpy as np
import pytest

from bladerub.blade.model import stiffness_at
from bladerub.blade.reduction import fit_speeds, speed_law

F_MAX = 0.4


@pytest.mark.parametrize("count", [3, 4, 7])
def test_any_number_of_fits_is_met_by_as_many_even_powers(count):
    rng = np.random.default_rng(count)
    terms = [matrix / F_MAX ** (2 * power) for power, matrix in enumerate(rng.standard_normal((count, 6, 6)))]

    def stiffness(f_omega):
        return sum(f_omega ** (2 * power) * term for power, term in enumerate(terms))

    fits = fit_speeds(F_MAX, count)
    coefficients = speed_law([stiffness(f_omega) for f_omega in fits], F_MAX)
    assert len(coefficients) == count
    for f_omega in (0.33, *fits):
        np.testing.assert_allclose(stiffness_at(coefficients, f_omega), stiffness(f_omega), atol=1e-10)
    assert list(fit_speeds(F_MAX, 3)) == [0.0, F_MAX / 2, F_MAX]
