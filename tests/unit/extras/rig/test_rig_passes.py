"""Passes of a rigid tip: limits, convergence, heat; and what a rig may not be."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.rig.passes import simulate_passes
from bladerub.extras.rig.spec import Rig

RIG = Rig(
    "bench",
    E=1.2e9,
    K=0.3e9,
    yield_stress=9e6,
    thickness=3e-3,
    tip_width=1e-2,
    tip_length=2e-3,
    track=1.0,
    speed=125.0,
    incursion=1e-4,
)


def last(rig, **fineness):
    return simulate_passes(rig, **fineness).iloc[-1]


def test_theta_turns_the_force_and_the_impulse_is_over_the_coated_part():
    whole, turned, part = last(RIG), last(replace(RIG, theta=0.3)), last(replace(RIG, coated=0.1))
    assert turned.normal_force == pytest.approx(math.cos(0.3) * whole.normal_force)
    by_wear = whole.tangential_force  # θ has no part in it
    assert turned.tangential_force == pytest.approx(math.sin(0.3) * whole.normal_force + by_wear)
    assert whole.normal_impulse == pytest.approx(whole.normal_force / 125.0)
    assert part.normal_impulse == pytest.approx(0.1 * whole.normal_impulse)
    assert part.pass_energy == pytest.approx(0.1 * whole.pass_energy)


def test_without_lasting_hardening_the_force_of_a_constant_feed_becomes_constant():
    law = described_law("brittle", {"break_strain": 0.004})
    fed = replace(RIG, yield_stress=0.0, incursion=1e-6, passes=120)
    hardening, steady = simulate_passes(fed), simulate_passes(replace(fed, law=law))
    assert hardening.normal_force[119] > 1.15 * hardening.normal_force[99]
    assert steady.normal_force[119] == pytest.approx(steady.normal_force[99])
    assert steady.pass_wear[119] == pytest.approx(1e-6)  # all that it is fed


def test_a_rounded_tip_converges_with_the_elements_and_its_energy_to_second_order_with_the_steps():
    forces = [last(replace(RIG, edge_drop=4e-5), elements=n).normal_force for n in (10, 20, 40, 80)]
    changes = np.abs(np.diff(forces))
    assert np.all(changes[1:] < 0.5 * changes[:-1])
    assert changes[-1] < 1e-3 * forces[-1]
    rounded = replace(RIG, edge_drop=9e-5, incursion=5e-5, passes=2)
    coarse, fine = (last(rounded, steps=n).energy_residual for n in (8, 32))
    assert fine < coarse / 8
    assert coarse < 1e-3


def test_a_viscous_coating_resists_a_faster_tip_more():
    viscous = replace(RIG, edge_drop=4e-5, law=described_law("viscoplastic", {"viscosity": 1e4}))
    slow, fast = (last(replace(viscous, speed=speed)).normal_force for speed in (1e-3, 125.0))
    assert slow == pytest.approx(last(replace(RIG, edge_drop=4e-5)).normal_force, rel=1e-3)
    assert fast > 1.02 * slow


def test_passes_warm_a_coating_that_heats():
    hot = replace(RIG, incursion=1e-6, passes=60, theta=0.3, law=described_law("thermal", LAYER))
    passes, cold = simulate_passes(hot), simulate_passes(replace(hot, law=RIG.law))
    assert passes.temperature_rise.iloc[0] == 0
    assert np.all(np.diff(passes.temperature_rise) > 0)
    assert np.all(cold.temperature_rise.isna())
    assert np.all(passes.normal_force[1:] < cold.normal_force[1:])
    np.testing.assert_allclose(passes.worn_depth, cold.worn_depth)  # E and K fall alike


def test_what_a_rig_may_not_be_is_named():
    with pytest.raises(ValueError, match=r"tip_length = 0.5: must be at most the track, 0.4"):
        replace(RIG, tip_length=0.5, track=0.4)
