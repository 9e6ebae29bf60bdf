"""A flat rigid tip on a plastic coating in closed form.

The tip presses an element of the layer (thickness h) to the depth d. Plasticity with linear hardening (Simo
and Hughes 1998, box 1.4) leaves the strain ``w/h = (E d/h − σ_Y) / (E + K)`` and the stress ``E (d − w)/h``,
and has taken the energy ``(σ_Y + K w / 2h) w`` per area.
"""

import pytest

from bladerub.extras.rig.passes import simulate_passes
from bladerub.extras.rig.spec import Rig


@pytest.mark.parametrize(("E", "K", "yield_stress"), [(1.2e9, 3e8, 9e6), (6e8, 3e8, 0.0), (2e9, 0.0, 5e6)])
def test_forces_wear_and_energy_of_each_pass(E, K, yield_stress):
    h, width, length, track = 3e-3, 1e-2, 2e-3, 0.8
    rig = Rig("flat", E, K, yield_stress, h, width, length, track, 100.0, incursion=2e-5, passes=8)
    before = 0.0
    for row in simulate_passes(rig).itertuples():
        d = row.tip_depth
        w = max(0.0, h * (E * d / h - yield_stress) / (E + K), before)
        stress = E * (d - w) / h
        taken = sum(sign * (yield_stress + K * end / h / 2) * end for sign, end in ((1, w), (-1, before)))
        assert row.worn_depth == pytest.approx(w)
        assert row.largest_pressure == pytest.approx(stress)
        assert row.normal_force == pytest.approx(stress * width * length)
        assert row.tangential_force == pytest.approx(taken * width, abs=1e-9)
        assert row.pass_energy == pytest.approx(taken * width * track, abs=1e-9)
        before = w
