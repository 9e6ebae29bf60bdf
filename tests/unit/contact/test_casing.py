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


def test_gap_closes_to_clearance_less_interference_at_the_lobes():
    angle = np.linspace(0, 2 * np.pi, 3601)
    g = gap(TWO, 50e-6, angle)
    assert g.min() == pytest.approx(50e-6 - 0.36e-3)
    assert g.max() == pytest.approx(50e-6 - 0.36e-3 + 2e-3)
    assert angle[g.argmin()] % np.pi == pytest.approx(0.0)


def test_two_bumps_leave_the_gap_of_the_open_benchmark():
    """Piollet, Nyssen and Batailly (2019), eqs. (3) and (4): mean gap 0.356 mm, relative width 0.15."""
    mean = 0.356e-3
    casing = Casing("bumps", (2,), (1.0,), 2 * mean, 2 * mean, 0.0, bump_width=0.15)
    angle = np.linspace(0, 2 * np.pi, 1001)
    from_widest = np.mod(angle + np.pi / 2, np.pi) / np.pi - 0.5
    expected = mean * (1 - 2 * np.exp(-((from_widest / 0.15) ** 2)))
    np.testing.assert_allclose(gap(casing, mean, angle), expected, atol=1e-18)


def test_a_measured_shape_passes_through_its_points_and_closes():
    angle = np.deg2rad([10, 60, 100, 200, 290, 350])
    inward = np.array([0.2, 1.0, 0.4, 0.0, 0.7, 0.1])
    casing = Casing("m", (), (), 1e-3, 0.5e-3, 0.0, measured=tuple(zip(angle, inward, strict=True)))
    np.testing.assert_allclose(shape(casing, angle + 2 * np.pi), inward, atol=1e-12)
    between = shape(casing, np.linspace(-7, 7, 20_001))
    assert 0 <= between.min() < 1e-6
    assert 1 - 1e-6 < between.max() <= 1
    assert np.abs(np.diff(between)).max() < 0.01  # without a jump where the turn closes
