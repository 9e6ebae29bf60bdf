"""An elastic bar that is thrown at a rigid wall, or bounces on it: the compiled time loop against d'Alembert.

Source: Doyen, Ern and Piperno, SIAM Journal on Scientific Computing 33 (2011) 223-249, whose two benchmarks
these are. Of their four groups of schemes, those that leave the mass of the contact node as it is trigger
spurious oscillations of the contact force; those that move it off the node (Khenous, Laborde and Renard,
European Journal of Mechanics A 27 (2008) 918-932) do not. The exponential scheme belongs to the second kind:
the end of the bar answers a force at once, by the compliance of its condensed modes.

The bar is the sum of its free-free modes ω_k = kπc/L, end displacement 1/√m (k = 0) and √(2/m), and is radial
at node 1. Gravity is the frame: the bar rests, the rigid casing comes at v + gτ, by its gap.

In that frame a force F at the end (per unit of cross-section) sends out a wave, which returns from the free
end after the crossing time T = 2L/c and doubles where it arrives, so the end moves at
w′(τ) = (F(τ) + 2 F(τ − T) + 2 F(τ − 2T) + ...) / (ρ c). Touching means that this is the speed of the wall:

    F(τ) = ρ c (v + gτ) − 2 F(τ − T) − 2 F(τ − 2T) − ...

First contact: F = ρc (v + gτ) for 0 < τ < T. Then F would be ρc (2gT − v − gτ), negative after T where
v > gT: the end leaves. The impulse ρc (vT + gT²/2) over ρL is 2v + gT, and the frame has come down to v + gT:
the centre of mass leaves upward at v again.

Expected: rebound time and speed to 0.1 % at 2,000 steps a contact; after the front (the first 20th of the
contact) a force within 0.1 %; at the front a peak of at most 1.5 times (modified mass: 1.3, 640 elements).
"""

import numpy as np
import pytest
from loop_by_hand import simulation

from bladerub.contact.modes import Modes
from bladerub.contact.schemes import Contact, exponential

LENGTH, MODULUS, DENSITY = 10.0, 900.0, 1.0  # m, Pa, kg/m³
WAVE_SPEED = np.sqrt(MODULUS / DENSITY)
IMPEDANCE = DENSITY * WAVE_SPEED  # ρ c: stress per change of speed, Pa s/m
T = 2 * LENGTH / WAVE_SPEED
SPEED, GRAVITY = 10.0, 10.0
"""Thrown at 10 m/s without gravity (impacting) or dropped from 5 m with it (bouncing): 10 m/s at touch."""


def first_force(gravity, tau):
    """F(τ) of the first contact, Pa; 0 outside of it."""
    return np.where((tau >= 0) & (tau < T), IMPEDANCE * (SPEED + gravity * tau), 0.0)


def second_force(tau):
    """F(τ) of the second contact where it begins at 4T, that is for v = 3gT/2 as in the benchmark, Pa.

    There F(4T + s) = ρc (v + 4gT + gs) − 2 F(s) = ρc (4gT − v − gs): the first contact run backwards. The
    waves cancel, w′ = 8gT is uniform from 5T on, and the bar leaves undeformed at v.
    """
    s = tau - 4 * T
    return np.where((s >= 0) & (s < T), IMPEDANCE * (4 * GRAVITY * T - SPEED - GRAVITY * s), 0.0)


STEPS = 2001  # in the contact; odd, so that no mode has ω h = π
N_MODES = 4000
LEAD_IN = 0.1  # of the contact


def fall(gravity, duration):
    """Let the casing fall on the resting bar; one call of the loop a step, to see every force.

    Returns time from the first touch (s), force on the bar (N), speed of its centre of mass upwards (m/s).
    """
    k = np.arange(N_MODES)
    tip_modes = np.zeros((16, N_MODES))
    tip_modes[0] = np.sqrt(np.where(k == 0, 1.0, 2.0) / (DENSITY * LENGTH))
    modes = Modes(k * np.pi * WAVE_SPEED / LENGTH, tip_modes, 8)
    step = T / STEPS
    contact = Contact(np.full(8, np.inf), -1.0, 0.0)
    rule = exponential(modes, 0.0, step, contact)
    n_steps = round((LEAD_IN * T + duration) / step)
    at_centre = (np.arange(n_steps + 3) - 0.5) * step - LEAD_IN * T  # the first element only leads in
    gap = np.full((at_centre.size, 8), 1e6)  # out of reach of all nodes but the first
    gap[:, 0] = -SPEED * at_centre - gravity * at_centre**2 / 2
    loop = simulation(rule, contact, gap, radius=1e4, lever=1e4)
    force, speed = np.empty(n_steps), np.empty(n_steps)
    for i in range(n_steps):
        loop.advance(np.zeros(1), i + 1)
        force[i] = -loop.state.force[0, 0]
        speed[i] = -(loop.state.q[0, 0] - loop.state.q[1, 0]) / step * rule.tip[0, 0]
    time = step * np.arange(1, n_steps + 1) - LEAD_IN * T
    return time, force, speed - SPEED - gravity * (time - step / 2)


@pytest.fixture(scope="module")
def bouncing():
    return fall(GRAVITY, 5.5 * T)


def chatter(time, force, exact, start=0.0):
    """Largest relative error of the force after the front, and the peak at the front over the exact force."""
    during = (time > start + 0.05 * T) & (time < start + 0.95 * T)
    error = np.abs(force[during] / exact[during] - 1).max()
    return error, force[time < start + 0.05 * T].max() / exact[during][0]


@pytest.mark.parametrize("gravity", [0.0, GRAVITY], ids=["impacting", "bouncing"])
def test_rebound_without_chatter(gravity, bouncing):
    time, force, speed = bouncing if gravity else fall(0.0, 1.5 * T)
    pushed = time[(force > 0) & (time < 2 * T)]
    after = (time > 1.2 * T) & (time < 1.4 * T)
    leaving = np.mean(speed[after] + gravity * (time[after] - T))
    print(f"contact from {pushed[0]:.5f} to {pushed[-1]:.5f} s, speed {leaving:.5f} m/s")
    assert pushed[-1] - pushed[0] == pytest.approx(T, rel=1e-3)
    assert leaving == pytest.approx(SPEED, rel=1e-3)
    first = time < 2 * T
    found = chatter(time[first], force[first], first_force(gravity, time[first]))
    print("error and first peak of the force:", found)
    assert found[0] < 1e-3
    assert found[1] < 1.5


def test_second_impact_of_the_bouncing_bar(bouncing):
    time, force, speed = bouncing
    second = time > 2 * T
    pushed = time[second][force[second] > 0]
    leaving = np.mean((speed + GRAVITY * (time - 5 * T))[time > 5.2 * T])
    print(f"second contact from {pushed[0] / T:.4f} T to {pushed[-1] / T:.4f} T, speed {leaving:.5f} m/s")
    assert pushed[0] == pytest.approx(4 * T, rel=1e-3)
    assert pushed[-1] == pytest.approx(5 * T, rel=1e-3)
    assert leaving == pytest.approx(SPEED, rel=1e-3)
    exact = second_force(time[second])
    assert chatter(time[second], force[second], exact, 4 * T)[0] < 1e-3
