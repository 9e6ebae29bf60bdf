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
