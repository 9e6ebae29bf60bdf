"""Return mapping against the closed form of 1D plasticity with linear hardening.

Source: Simo and Hughes, Computational Inelasticity (1998), section 1.2 (Box 1.4 and eq. 1.2.45): the
elastoplastic modulus is E K / (E + K) and a strain increment beyond yield gives Δγ = f / (E + K).
"""

import numpy as np
import pytest

from bladerub.contact.law import load
from bladerub.contact.spec import Coating


@pytest.mark.parametrize(("E", "K"), [(0.11, 10.0), (1.1, 0.5), (20.0, 0.05), (20.0, 10.0)])
@pytest.mark.parametrize("yield_stress", [0.0, 0.01])
def test_cycle_follows_the_closed_form_whatever_the_path(E, K, yield_stress):
    coating = Coating(E, K, 0.0, yield_stress, 1.0, 5e-3, 2000)
    rng = np.random.default_rng(3)
    strain = np.concatenate([np.linspace(0, 0.1, 50), rng.uniform(0, 0.2, 400)])
    wear, highest = 0.0, 0.0
    for epsilon in strain:
        stress, wear = load(coating, epsilon * coating.thickness, wear)
        highest = max(highest, epsilon)
        # plastic strain and stress depend on the largest strain alone
        plastic = max(0.0, (E * highest - yield_stress) / (E + K))
        assert wear / coating.thickness == pytest.approx(plastic, rel=1e-12, abs=1e-15)
        assert stress == pytest.approx(max(0.0, E * (epsilon - plastic)), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(("E", "K"), [(0.11, 10.0), (1.1, 0.5), (20.0, 10.0)])
def test_wear_knows_neither_order_nor_step_size(E, K):
    """Rate independence: at once, in 1000 steps, or shuffled with lesser strains, the same wear and force."""
    coating = Coating(E, K, 0.0, 0.01, 1.0, 5e-3, 2000)
    top = 0.3 * coating.thickness
    paths = [np.array([top]), np.linspace(0, top, 1000)]
    rng = np.random.default_rng(5)
    paths += [np.append(rng.permutation(np.linspace(0, top, 200)), top) for _ in range(5)]
    ends = []
    for path in paths:
        wear = 0.0
        for penetration in path:
            stress, wear = load(coating, penetration, wear)
        ends.append((float(stress), float(wear)))
    np.testing.assert_allclose(ends, [ends[0]] * len(ends), rtol=1e-12)


def test_one_cycle_dissipates_the_closed_form_energy():
    """½ E_T ε² (1 − E_T/E) per volume for σ_Y = 0."""
    E, K, top = 1.1, 0.5, 0.2
    coating = Coating(E, K, 0.0, 0.0, 1.0, 5e-3, 2000)
    strain = np.concatenate([np.linspace(0, top, 4001), np.linspace(top, 0, 4001)])
    stress, wear = np.zeros(strain.size), 0.0
    for i, epsilon in enumerate(strain):
        stress[i], wear = load(coating, epsilon * coating.thickness, wear)
    tangent = E * K / (E + K)
    expected = 0.5 * tangent * top**2 * (1 - tangent / E)
    assert np.trapezoid(stress, strain) == pytest.approx(expected, rel=1e-6)
