import numpy as np
import pytest

from bladerub.contact.casing import gap, shape
from bladerub.contact.spec import Casing

TWO = Casing("2nd", (2,), (1.0,), 1e-3, 0.36e-3, 0.0)
BOTH = Casing("2nd5nd", (2, 5), (0.25, 1.0), 0.5e-3, 0.36e-3, 0.0)


def test_shape_is_the_scaled_sum_of_nodal_diameters():
    angle = np.linspace(0, 2 * np.pi, 1001)
    np.testing.assert_allclose(shape(TWO, angle), np.cos(2 * angle))
    expected = (0.25 * np.cos(2 * angle) + np.cos(5 * angle)) / 1.25
    np.testing.assert_allclose(shape(BOTH, angle), expected, atol=1e-9)


@pytest.mark.parametrize("weights", [(0.25, 1.0), (1.0, -0.5), (-1.0, -1.0)])
def test_largest_shape_is_one(weights):
    casing = Casing("x", (2, 5), weights, 1e-3, 0.3e-3, 0.0)
    assert shape(casing, np.linspace(0, 2 * np.pi, 100_000)).max() == pytest.approx(1.0, abs=1e-6)


def test_gap_closes_to_clearance_less_interference_at_the_lobes():
    angle = np.linspace(0, 2 * np.pi, 3601)
    g = gap(TWO, 50e-6, angle)
    assert g.min() == pytest.approx(50e-6 - 0.36e-3)
    assert g.max() == pytest.approx(50e-6 - 0.36e-3 + 2e-3)
    assert angle[g.argmin()] % np.pi == pytest.approx(0.0)
