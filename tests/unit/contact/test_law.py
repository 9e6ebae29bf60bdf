import numpy as np
import pytest

from bladerub.contact.law import load
from bladerub.contact.spec import Coating

COATING = Coating(
    E=2.0, K=0.5, theta=0.0, yield_stress=0.02, modulus_unit=150e6, thickness=5e-3, n_elements=2000
)


def test_below_the_worn_surface_nothing_happens():
    stress, wear = load(COATING, [-1e-4, 0.0, 2e-4], [0.0, 0.0, 3e-4])
    assert not stress.any()
    np.testing.assert_array_equal(wear, [0, 0, 3e-4])


def test_below_the_elastic_limit_loading_is_elastic():
    stress, wear = load(COATING, 0.009 * 5e-3, 0.0)
    assert stress == pytest.approx(2.0 * 0.009)
    assert wear == 0


def test_scalars_broadcast_against_arrays():
    stress, wear = load(COATING, np.full((2, 3), 1e-3), 0.0)
    assert stress.shape == wear.shape == (2, 3)
    assert np.unique(stress).size == 1


def test_repeated_contact_at_one_depth_wears_no_further():
    first_stress, wear = load(COATING, 1e-3, 0.0)
    stress, worn_again = load(COATING, 1e-3, wear)
    assert stress == pytest.approx(first_stress)
    assert worn_again == pytest.approx(wear, rel=1e-14)


def test_perfectly_plastic_coating_keeps_its_limit():
    soft = Coating(2.0, 0.0, 0.0, 0.02, 150e6, 5e-3, 2000)
    stress, wear = load(soft, [1e-3, 2e-3], 0.0)
    np.testing.assert_allclose(stress, 0.02)
    np.testing.assert_allclose(wear, np.array([1e-3, 2e-3]) - 0.01 * 5e-3)
