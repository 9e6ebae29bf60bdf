"""Order of convergence of the two schemes in smooth contact, and of what the energy ledger misses.

Source: a Gautschi-type integrator is of second order (Hochbruck and Lubich, Numerische Mathematik 83 (1999)
403-426); central differences with the contact force of the predicted position are of first order (one mass on
one bar has the roots of a damped oscillator, damping ratio ∝ h).

The blade's tip runs through an arc of soft coating once a turn, coming and leaving tangentially, three turns
long. Displacement of the tip at eight instants a turn and wear are compared with those of a step 32 times
finer. Expected: order 2 (exponential, at least 1.8) and 1 (central differences).

The ledger's quadratures are of second order in the step, and the blade's own balance holds to rounding
(`bladerub.contact.schemes`, contract 5); what is left over is the coating's. Expected: order 2.
"""

import numpy as np
import pytest
from loop_by_hand import ONES, simulation

from bladerub.contact.modes import modes_at
from bladerub.contact.schemes import SCHEMES, Contact

F_OMEGA, REVOLUTIONS, N = 0.3, 3, 400
ELASTIC, THETA, DAMPING = 2e5, 0.1, 2.3e-3
HALF_WIDTH, EDGE_DROP, DEPTH, RADIUS = 4.0, 20e-6, 0.2e-3, 0.65


def march(blade, scheme, steps_per_element):
    """Tip displacements (24, 16) and wear (N, 8) with so many steps an element."""
    step = 1 / (F_OMEGA * blade.f1_hz * N * steps_per_element)
    contact = Contact(2 * HALF_WIDTH * ELASTIC * ONES, -np.cos(THETA), -np.sin(THETA))
    rule = SCHEMES[scheme](modes_at(blade, F_OMEGA), DAMPING, step, contact)
    angle = (np.arange(N) + 0.5) * 2 * np.pi / N
    gap = np.tile(1e-3 * (1 + np.cos(angle)) - DEPTH, (8, 1)).T.copy()
    profile = {"half_width": HALF_WIDTH, "curvature": EDGE_DROP / HALF_WIDTH**2}
    place = {"start": np.linspace(0, 20, 8), "per_metre": N / (2 * np.pi * RADIUS)}
    place |= {"radius": RADIUS, "lever": RADIUS}
    loop = simulation(rule, contact, gap, 0.5, steps=steps_per_element, limit=1.0, **profile, **place)
    piece = np.zeros(N // 8)
    seen = []
    for part in range(8 * REVOLUTIONS):
        loop.advance(piece, part % 8 * piece.size)
        seen.append(loop.state.u[0, :16].copy())
    return np.array(seen), loop.state.wear


@pytest.fixture(scope="module")
def fine(coarse_blade):
    return march(coarse_blade, "exponential", 8 * 32)


@pytest.mark.parametrize(
    ("scheme", "coarsest", "lowest", "highest"),
    [("exponential", 8, 1.8, 2.3), ("central_differences", 128, 0.8, 1.4)],
)
def test_order(coarse_blade, fine, scheme, coarsest, lowest, highest):
    steps = coarsest * 2 ** np.arange(4)
    errors = []
    for run in (march(coarse_blade, scheme, n) for n in steps):
        pairs = zip(run, fine, strict=True)
        errors.append([np.linalg.norm(found - exact) / np.linalg.norm(exact) for found, exact in pairs])
    orders = -np.polyfit(np.log(steps), np.log(errors), 1)[0]
    print(f"{scheme}: order {orders[0]:.2f} in displacement, {orders[1]:.2f} in wear; errors {errors}")
    assert np.all(orders > lowest)
    assert np.all(orders < highest)


@pytest.mark.extras(cases=r"True")
@pytest.mark.parametrize(
    ("E", "K", "theta", "f_omega", "turns"),
    [
        (1.1, 0.5, 0.0, 0.12, False),
        (20.0, 10.0, 0.0, 0.31, False),
        (1.1, 0.5, 0.15, 0.31, False),
        (1.1, 0.5, 0.15, 0.31, True),
    ],
)
def test_residual_is_of_second_order(run, E, K, theta, f_omega, turns):
    steps = np.array([20, 40, 80, 160])
    residual = [
        abs(run(E, K, f_omega, theta, turns=turns, revolutions=4, steps_per_element=n).energy.residual)
        for n in steps
    ]
    order = -np.polyfit(np.log(steps), np.log(residual), 1)[0]
    print(f"E = {E}, K = {K}, theta = {theta}, f_omega = {f_omega}: order {order:.2f}, residual {residual}")
    assert order > 1.7
    assert residual[0] < 1e-5
