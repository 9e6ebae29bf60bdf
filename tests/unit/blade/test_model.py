import dataclasses

import numpy as np
import pytest

from bladerub.blade.model import write_reduced_blade
from bladerub.blade.validation import read_reduced_blade


@pytest.fixture
def finer(blade):
    """A blade whose fit had five speeds."""
    n = len(blade.mass)
    return dataclasses.replace(blade, stiffness_higher=(3 * np.eye(n), -5 * np.eye(n)))


def test_every_coefficient_is_stored_and_read(finer, tmp_path):
    write_reduced_blade(tmp_path / "blade.h5", finer, {})
    read = read_reduced_blade(tmp_path / "blade.h5")
    assert len(read.stiffness_higher) == 2
    assert read.arrays.keys() == finer.arrays.keys() >= {"stiffness_3", "stiffness_4"}
    for name, matrix in finer.arrays.items():
        np.testing.assert_array_equal(read.arrays[name], matrix)


def test_higher_coefficients_add_the_next_even_powers(blade, finer):
    without = dict.fromkeys(("stiffness_0", "stiffness_1", "stiffness_2"), 0 * blade.mass)
    added = dataclasses.replace(finer, **without).stiffness(0.3)
    np.testing.assert_allclose(np.diag(added), 3 * 0.3**6 - 5 * 0.3**8, rtol=1e-12)
    np.testing.assert_allclose(finer.stiffness(0.3), blade.stiffness(0.3) + added, rtol=1e-12)


def test_a_speed_beyond_the_fit_is_refused(blade):
    np.testing.assert_array_equal(blade.stiffness(0.0), blade.stiffness_0)
    blade.stiffness(0.4)
    for f_omega in (0.4001, -0.0001):
        with pytest.raises(ValueError, match=r"is outside the fitted range \[0, 0.4\]"):
            blade.stiffness(f_omega)
