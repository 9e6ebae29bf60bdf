import dataclasses

import numpy as np
import pytest
import scipy

from bladerub.contact.casing import gap, shape
from bladerub.contact.illustration import loading_cycle, pressed_elements
from bladerub.contact.spec import Casing, Coating, TipProfile
from bladerub.contact.tip import coverage, highest, mean_coverage, relief

BOTH = Casing("2nd5nd", (2, 5), (0.25, 1.0), 0.5e-3, 0.36e-3, 0.0)
COATING = Coating(2.0, 0.5, 0.15, yield_stress=0.01, modulus_unit=1e8, thickness=5e-3, n_elements=2000)
TIP = TipProfile(half_width=2.0, edge_drop=20e-6)


def test_shape_is_the_scaled_sum_of_nodal_diameters():
    angle = np.linspace(0, 2 * np.pi, 1001)
    expected = (0.25 * np.cos(2 * angle) + np.cos(5 * angle)) / 1.25
    np.testing.assert_allclose(shape(BOTH, angle), expected, atol=1e-9)
    inverse = Casing("2nd4th", (2, 4), (1.0, -1.0), 0.5e-3, 0.36e-3, 0.0)  # highest where cos 2 φ = 1/4
    expected = (np.cos(2 * angle) - np.cos(4 * angle)) * 8 / 9
    np.testing.assert_allclose(shape(inverse, angle), expected, atol=1e-7)


def test_gap_closes_to_clearance_less_interference_at_the_lobes():
    """Eq. (7), and opens by twice the amplitude of the one nodal diameter between them."""
    angle = np.linspace(0, 2 * np.pi, 3601)
    found = gap(Casing("2nd", (2,), (1.0,), 1e-3, 0.36e-3, 0.0), 50e-6, angle)
    assert (found.min(), found.max()) == pytest.approx((50e-6 - 0.36e-3, 50e-6 - 0.36e-3 + 2e-3))
    assert angle[found.argmin()] % np.pi == pytest.approx(0.0)


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


def test_a_loading_cycle_follows_the_moduli():
    cycle = loading_cycle(COATING, (0.0, 0.03, 0.0), steps=30)
    np.testing.assert_allclose(cycle.strain, np.concatenate([np.arange(31), np.arange(29, -1, -1)]) * 1e-3)
    plastic = (2 * 0.03 - 0.01) / 2.5
    assert cycle.plastic_strain[30:] == pytest.approx(plastic)
    assert cycle.stress[30] == pytest.approx(2 * (0.03 - plastic))
    np.testing.assert_allclose(cycle.stress[:5], 2 * cycle.strain[:5])  # below the elastic limit
    np.testing.assert_allclose(np.diff(cycle.stress[8:30]), 1e-3 * 2 * 0.5 / 2.5)
    assert cycle.stress[-1] == 0


@pytest.mark.extras
def test_a_loading_cycle_is_by_the_law_of_the_coating_at_a_rate():
    from bladerub.extras.law_reading import described_law

    viscous = dataclasses.replace(COATING, element_law=described_law("viscoplastic", {"viscosity": 1e4}))
    slow, fast = (loading_cycle(viscous, (0.0, 0.03, 0.0), 300, rate) for rate in (1e-3, 1e7))
    plastic = loading_cycle(COATING, (0.0, 0.03, 0.0), 300)
    np.testing.assert_allclose(slow.stress, plastic.stress, atol=1e-6)
    np.testing.assert_allclose(fast.stress, 2 * fast.strain, atol=1e-4)
    between = loading_cycle(viscous, (0.0, 0.03, 0.0), 300, 1000.0).stress[300]
    rise = 1 - np.exp(-(2.5e8 / 1e4) * (0.03 - 0.005) / 1000)  # of the overstress since yielding
    assert 1e8 * (between - plastic.stress[300]) == pytest.approx(1e7 * (2 / 2.5) ** 2 * rise, rel=0.02)


def test_elements_behind_the_tip_are_worn_and_those_ahead_are_not():
    profile = TipProfile(half_width=3.0, edge_drop=1e-4)
    scene = pressed_elements(COATING, profile, 0.65, depth=1.5e-4, reach=6)
    assert scene.element.tolist() == list(range(-6, 7))
    assert scene.width == pytest.approx(2 * np.pi * 0.65 / 2000)
    behind, ahead = scene.element < -3, scene.element > 3
    assert (scene.wear[behind] > 0).all()
    assert scene.wear[behind] == pytest.approx(scene.wear[0])
    assert not scene.wear[ahead].any()
    assert scene.shortening[6] == pytest.approx(1.5e-4)
    np.testing.assert_array_equal(scene.shortening[behind], scene.wear[behind])
    assert not scene.stress[behind | ahead].any()


def test_profile_is_a_parabola_and_coverage_fades_over_the_width_of_one_element():
    np.testing.assert_allclose(relief(TIP, np.array([0.0, 1.0, 2.0, -2.0])), [0, 5e-6, 20e-6, 20e-6])
    np.testing.assert_allclose(coverage(TIP, np.array([1.5, 2.0, 2.25, 2.5, 3.0])), [1, 0.5, 0.25, 0, 0])
    for advance in (0.1, 0.25, 1.0):
        to = np.linspace(-4, 3, 97)
        path = coverage(TIP, to + advance * np.linspace(0, 1, 2001)[:, None])
        mean = mean_coverage(path[0], path[-1], 1 / advance)
        np.testing.assert_allclose(mean, scipy.integrate.simpson(path, axis=0) / 2000, atol=1e-6)


@pytest.mark.parametrize("tilt", [1e-9, 3e-6, 19e-6, 40e-6])
@pytest.mark.parametrize("edge_drop", [0.0, 20e-6])
def test_highest_point_of_a_tilted_profile_is_that_of_a_search(tilt, edge_drop):
    tip = TipProfile(half_width=2.0, edge_drop=edge_drop)
    offset = np.linspace(-2.5, 2.5, 20_001)
    with np.errstate(divide="ignore"):  # a flat profile is highest at its edge
        found = highest(tip, np.array(tilt))
    assert found == pytest.approx(np.max(tilt * offset - relief(tip, offset)), rel=1e-6, abs=1e-13)


def test_rolling_tip_touches_where_a_circle_of_its_curvature_does():
    """A circle of radius R that rolls by ψ about its lowest point comes ψ² R / 2 closer."""
    width, radius, angle = 2e-3, 0.4, 5e-3  # m, m, rad
    tip = TipProfile(half_width=2.0, edge_drop=(2.0 * width) ** 2 / (2 * radius))
    assert highest(tip, np.array(angle * width)) == pytest.approx(angle**2 * radius / 2)
