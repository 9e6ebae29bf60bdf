import dataclasses

import numpy as np
import pytest

from bladerub.contact.illustration import loading_cycle, pressed_elements
from bladerub.contact.laws import described_law
from bladerub.contact.spec import Coating, TipProfile

COATING = Coating(2.0, 0.5, 0.15, yield_stress=0.01, modulus_unit=1e8, thickness=5e-3, n_elements=2000)


def test_a_loading_cycle_follows_the_moduli():
    cycle = loading_cycle(COATING, (0.0, 0.03, 0.0), steps=30)
    np.testing.assert_allclose(cycle.strain, np.concatenate([np.arange(31), np.arange(29, -1, -1)]) * 1e-3)
    plastic = (2 * 0.03 - 0.01) / 2.5
    assert cycle.plastic_strain[30:] == pytest.approx(plastic)
    assert cycle.stress[30] == pytest.approx(2 * (0.03 - plastic))
    np.testing.assert_allclose(cycle.stress[:5], 2 * cycle.strain[:5])  # below the elastic limit
    np.testing.assert_allclose(np.diff(cycle.stress[8:30]), 1e-3 * 2 * 0.5 / 2.5)
    assert cycle.stress[-1] == 0


def test_a_loading_cycle_is_by_the_law_of_the_coating_at_a_rate():
    viscous = dataclasses.replace(COATING, element_law=described_law("viscoplastic", {"viscosity": 1e4}))
    slow, fast = (loading_cycle(viscous, (0.0, 0.03, 0.0), 300, rate) for rate in (1e-3, 1e7))
    plastic = loading_cycle(COATING, (0.0, 0.03, 0.0), 300)
    np.testing.assert_allclose(slow.stress, plastic.stress, atol=1e-6)
    np.testing.assert_allclose(fast.stress, 2 * fast.strain, atol=1e-4)
    steady = loading_cycle(viscous, (0.0, 0.03, 0.0), 300, 1000.0).stress[300] - plastic.stress[300]
    rise = 1 - np.exp(-(2.5e8 / 1e4) * (0.03 - 0.005) / 1000)  # of the overstress since yielding
    # overstress η r E / (E + K) at the end, less the hardening that it holds back
    assert steady * 1e8 == pytest.approx(1e4 * 1000 * (2 / 2.5) ** 2 * rise, rel=0.02)


@pytest.fixture
def scene():
    return pressed_elements(COATING, TipProfile(half_width=3.0, edge_drop=1e-4), 0.65, depth=1.5e-4, reach=6)


def test_elements_behind_the_tip_are_worn_and_those_ahead_are_not(scene):
    assert scene.element.tolist() == list(range(-6, 7))
    assert scene.width == pytest.approx(2 * np.pi * 0.65 / 2000)
    behind, ahead = scene.element < -3, scene.element > 3
    assert (scene.wear[behind] > 0).all()
    assert scene.wear[behind] == pytest.approx(scene.wear[0])
    assert not scene.wear[ahead].any()
    assert not scene.stress[behind | ahead].any()
