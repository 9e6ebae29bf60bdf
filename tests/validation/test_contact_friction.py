"""Coulomb friction against closed forms, and against the constant direction where sliding never turns.

A mass m on a spring k slides over a casing that passes at the speed V under the constant friction T. In the
phase plane (x, v/ω) it moves on circles, about −T/k while it slides with the rotation and about T/k while it
slides back, v < −V. With d = T/k and w = V/ω, a circle of the radius r = √(w² + s²) turns at s on its way
back and is left for one with s − 4d after a cycle; once s is at most 4d the mass sticks and leaves along the
circle of the radius w, which it keeps: friction takes what vibration is faster than the rotation, and no more
(piecewise linear oscillator; Den Hartog, Mechanical Vibrations, 1956, section 8.2, has the arcs for V = 0).
"""

import numpy as np
import pytest
from loop_by_hand import ONES, simulation

from bladerub.contact.modes import Modes
from bladerub.contact.schemes import SCHEMES, Contact

M, OMEGA, W, D = 0.1, 1.0, 1.0, 0.5
N, PER_CYCLE = 4096, 400
STEP = 2 * np.pi / PER_CYCLE
PUSH, THETA = 0.25, 0.2


def vibration(s_0, coulomb, n_cycles, scheme):
    """Distance from −d (n,) of the mass in each step, from s = `s_0`.

    Below 0 for a circle with r² = w² − s², which never turns.
    """
    d = PUSH * np.sin(THETA) / (M * OMEGA**2)
    unit = d / D  # lengths are in parts of it
    speed = OMEGA * W * unit
    tip_modes = np.zeros((16, 1))
    tip_modes[8, 0] = M**-0.5  # only along the casing
    contact = Contact(PUSH * ONES, -np.cos(THETA), -np.sin(THETA))
    rule = SCHEMES[scheme](Modes(np.array([OMEGA]), tip_modes, 8), 0.0, STEP, contact)
    gap = np.ones((N, 8))
    gap[:, 0] = -1.0
    place = {"per_metre": 1 / (speed * STEP), "radius": 1e9, "lever": N * speed * STEP / (2 * np.pi)}
    loop = simulation(rule, contact, gap, coulomb=coulomb, **place)
    state = loop.state
    start = np.sqrt(W**2 + s_0 * abs(s_0))  # from −d, where the circle is farthest out
    positions = unit * np.array([start, start * np.cos(OMEGA * STEP), start * np.cos(2 * OMEGA * STEP)]) - d
    state.q[:, 0] = positions / tip_modes[8, 0]
    state.u[:, 8] = positions
    state.normal_force[0, 0], state.force[0, 8] = PUSH, PUSH * contact.tangential
    seen = np.empty(n_cycles * PER_CYCLE)
    for i in range(seen.size):
        loop.advance(np.zeros(1), i)
        seen[i] = (state.u[0, 8] + d) / unit
    return seen


def peaks(x):
    return x[1:-1][(x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:])]


SCHEME = pytest.mark.parametrize("scheme", ["exponential", "central_differences"])


@SCHEME
def test_each_cycle_takes_four_times_the_static_deflection(scheme):
    s_0, n = 9.0, 4
    found = peaks(vibration(s_0, True, n + 1, scheme))[:n]
    expected = np.hypot(W, s_0 - 4 * D * np.arange(1, n + 1))
    print(scheme, found / expected - 1)
    np.testing.assert_allclose(found, expected, rtol=5e-3)


@SCHEME
@pytest.mark.parametrize("s_0", [1.5, 3.0, 5.0])
def test_vibration_that_remains_is_as_fast_as_the_rotation(scheme, s_0):
    x = vibration(s_0, True, 8, scheme)
    np.testing.assert_allclose(peaks(x)[-3:], W, rtol=5e-3)
    np.testing.assert_allclose(-peaks(-x)[-3:], -W, rtol=5e-3)


@SCHEME
def test_a_constant_direction_takes_nothing_from_the_vibration(scheme):
    x = vibration(3.0, False, 8, scheme)
    np.testing.assert_allclose(peaks(x), np.hypot(W, 3.0), rtol=1e-3)


@pytest.mark.parametrize("f_omega", [0.02, 0.206])
def test_both_laws_agree_where_sliding_never_turns(run, f_omega):
    constant, coulomb = (run(2.0, 0.5, f_omega, 0.15, law=law, revolutions=5) for law in ("theta", "coulomb"))
    assert constant.n_reversed_steps == coulomb.n_reversed_steps == 0
    assert 0 < constant.slowest_sliding < 1
    scale = constant.revolution_peak.max()
    np.testing.assert_allclose(coulomb.revolution_peak, constant.revolution_peak, rtol=0, atol=1e-6 * scale)
    np.testing.assert_allclose(coulomb.wear, constant.wear, rtol=0, atol=1e-6 * constant.wear.max())


def test_a_blade_that_vibrates_faster_than_it_turns_is_damped(run):
    """A slow rotor and a first mode deflected by 2 mm: friction turns, and takes more than if it did not."""
    values = {"revolutions": 1, "initial_displacement": 2e-3}
    constant, coulomb = (run(2.0, 0.5, 0.002, 0.3, law=law, **values) for law in ("theta", "coulomb"))
    for result in (constant, coulomb):
        assert result.slowest_sliding < 0
        assert result.energy.residual < 1e-3
    assert coulomb.n_reversed_steps > 0
    assert coulomb.energy.sliding > 1.2 * constant.energy.sliding
