"""Impacting and bouncing bar through the compiled time loop, against d'Alembert's solution (`bar_solutions`).

Source: Doyen, Ern and Piperno, SIAM Journal on Scientific Computing 33 (2011) 223-249, whose two benchmarks
these are.

The bar is the sum of its free-free modes ω_k = kπc/L, end displacement 1/√m (k = 0) and √(2/m), and is radial
at node 1. Gravity is the frame: the bar rests, the rigid casing comes at v + gτ, by its gap.

Expected: rebound time and speed to 0.1 % at 2,000 steps a contact.
"""

from typing import NamedTuple

import numpy as np
import pytest
from bar_solutions import DOYEN, GRAVITY, SPEED, rebound_speed

from bladerub.contact import kernel
from bladerub.contact.modes import Modes
from bladerub.contact.schemes import Contact, exponential, normal_compliance

T = DOYEN.crossing
STEPS = 2001  # in the contact; odd, so that no mode has ω h = π
N_MODES = 4000
LEAD_IN = 0.1  # of the contact


class History(NamedTuple):
    """Time from the first touch (s), force on the bar (N), speed of its centre of mass upwards (m/s)."""

    time: np.ndarray
    force: np.ndarray
    speed: np.ndarray


def march(gravity, duration):
    """Let the casing fall on the resting bar; one call of the loop a step, to see every force."""
    k = np.arange(N_MODES)
    tip_modes = np.zeros((16, N_MODES))
    tip_modes[0] = np.sqrt(np.where(k == 0, 1.0, 2.0) / DOYEN.mass)
    modes = Modes(k * np.pi * DOYEN.wave_speed / DOYEN.length, tip_modes)
    step = T / STEPS
    rule = exponential(modes, 0.0, step, Contact(np.full(8, np.inf), -1.0, 0.0))

    n_steps = round((LEAD_IN * T + duration) / step)
    at_centre = (np.arange(n_steps + 3) - 0.5) * step - LEAD_IN * T  # the first element only leads in
    gap = np.full((8, at_centre.size), np.inf)
    gap[0] = -SPEED * at_centre - gravity * at_centre**2 / 2
    lowest = np.full_like(gap, np.inf)
    lowest[0] = -np.inf
    zeros, ones = np.zeros(8), np.ones(8)
    stator = kernel.Stator(
        gap=gap,
        lowest_gap=lowest,
        floor=lowest[0].copy(),
        elastic=ones,
        hardening=ones,
        strength=zeros,
        is_rigid=True,
        radial=-1.0,
        tangential=0.0,
        own_compliance=np.diag(normal_compliance(rule.compliance, -1.0, 0.0)).copy(),
    )
    here = kernel.Tip(
        start=zeros,
        per_metre=ones,
        radius=1e4 * ones,
        lever=1e4 * ones,
        half_width=2.0,
        edge_drop=0.0,
        stray=0.0,
        limit=1e6,
    )
    state = kernel.at_rest(rule.omega.size, at_centre.size)
    force, speed = np.empty(n_steps), np.empty(n_steps)
    for i in range(n_steps):
        tip = here._replace(start=np.full(8, i + 1.0))
        kernel.revolve(rule, stator, tip, state, 1, np.zeros(1))
        force[i] = -state.force[0, 0]
        speed[i] = -(state.q[0, 0] - state.q[1, 0]) / step * rule.tip[0, 0]
    time = step * np.arange(1, n_steps + 1) - LEAD_IN * T
    return History(time, force, speed - SPEED - gravity * (time - step / 2))


@pytest.fixture(scope="module")
def impacting():
    return march(0.0, 1.5 * T)


@pytest.fixture(scope="module")
def bouncing():
    return march(GRAVITY, 5.5 * T)


@pytest.mark.parametrize("case", ["impacting", "bouncing"])
def test_rebound(case, request):
    gravity = GRAVITY if case == "bouncing" else 0.0
    time, force, speed = request.getfixturevalue(case)
    pushed = time[(force > 0) & (time < 2 * T)]
    after = (time > 1.2 * T) & (time < 1.4 * T)
    leaving = np.mean(speed[after] + gravity * (time[after] - T))
    exact = rebound_speed(DOYEN, SPEED, gravity)
    print(f"contact from {pushed[0]:.5f} to {pushed[-1]:.5f} s, speed {leaving:.5f} m/s")
    assert pushed[-1] - pushed[0] == pytest.approx(T, rel=1e-3)
    assert leaving == pytest.approx(exact, rel=1e-3)


def test_second_impact_of_the_bouncing_bar(bouncing):
    time, force, speed = bouncing
    second = time > 2 * T
    pushed = time[second][force[second] > 0]
    leaving = np.mean((speed + GRAVITY * (time - 5 * T))[time > 5.2 * T])
    print(f"second contact from {pushed[0] / T:.4f} T to {pushed[-1] / T:.4f} T, speed {leaving:.5f} m/s")
    assert pushed[0] == pytest.approx(4 * T, rel=1e-3)
    assert pushed[-1] == pytest.approx(5 * T, rel=1e-3)
    assert leaving == pytest.approx(SPEED, rel=1e-3)
