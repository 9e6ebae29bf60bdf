import numpy as np
import pytest

from bladerub.contact.law import load
from bladerub.contact.spec import Coating

COATING = Coating(
    E=2.0, K=0.5, theta=0.0, yield_stress=0.02, modulus_unit=150e6, thickness=5e-3, n_elements=2000
)


def test_below_the_elastic_limit_loading_is_elastic():
    stress, wear = load(COATING, 0.009 * 5e-3, 0.0)
    assert stress == pytest.approx(2.0 * 0.009)
    assert wear == 0


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
