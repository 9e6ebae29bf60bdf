"""Order of convergence of the two schemes in smooth contact.

Source: a Gautschi-type integrator is of second order (Hochbruck and Lubich, Numerische Mathematik 83 (1999)
403-426); central differences with the contact force of the predicted position are of first order (one mass on
one bar has the roots of a damped oscillator, damping ratio ∝ h).

The blade's tip runs through an arc of soft coating once a turn, coming and leaving tangentially, three turns
long. Displacement of the tip at eight instants a turn and wear are compared with those of a step 32 times
finer. Expected: order 2 (exponential, at least 1.8) and 1 (central differences).
"""

import numpy as np
import pytest

from bladerub.contact import law
from bladerub.contact.kernel import records
from bladerub.contact.kernel.free_flight import free_flight
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.kernel.modal import pack
from bladerub.contact.modes import modes_at
from bladerub.contact.schemes import SCHEMES, Contact, normal_compliance

F_OMEGA, REVOLUTIONS, N = 0.3, 3, 400
ELASTIC, HARDENING, THETA, DAMPING = 2e5, 1e5, 0.1, 2.3e-3
HALF_WIDTH, EDGE_DROP, DEPTH, RADIUS = 4.0, 20e-6, 0.2e-3, 0.65


def march(blade, scheme, steps_per_element):
    """Tip displacements (24, 16) and wear (N, 8) with so many steps an element."""
    step = 1 / (F_OMEGA * blade.f1_hz * N * steps_per_element)
    radial, tangential = -np.cos(THETA), -np.sin(THETA)
    ones = np.ones(8)
    contact = Contact(2 * HALF_WIDTH * ELASTIC * ones, radial, tangential)
    rule = SCHEMES[scheme](modes_at(blade, F_OMEGA), DAMPING, step, contact)
    angle = (np.arange(N) + 0.5) * 2 * np.pi / N
    gap = np.tile(1e-3 * (1 + np.cos(angle)) - DEPTH, (8, 1)).T.copy()
    stator = records.Stator(
        initial_gap=gap,
        minimum_gap=np.full(N, -np.inf),
        law=np.outer(law.Element(ELASTIC, HARDENING, 0.0, 1 / ELASTIC, 1 / (ELASTIC + HARDENING)), ones),
        n_elements=N,
        is_rigid=False,
        normal_factor=radial,
        tangential_factor=tangential,
        self_compliance=np.diag(normal_compliance(rule.compliance, 8, radial, tangential)).copy(),
    )
    modal, flight, state = pack(rule), free_flight(rule, 1, 0.0), records.at_rest(rule.omega.size, N)
    piece = np.zeros(N // 8)
    seen = []
    tip = records.Tip(
        start=np.linspace(0, 20, 8),
        per_metre=N / (2 * np.pi * RADIUS) * ones,
        radius=RADIUS * ones,
        lever=RADIUS * ones,
        half_width=HALF_WIDTH,
        curvature=EDGE_DROP / HALF_WIDTH**2,
        search_range=0.0,
        limit=1.0,
    )
    for _ in range(8 * REVOLUTIONS):
        Simulation(modal, flight, stator, tip, state, steps_per_element).advance(piece)
        seen.append(state.u[0, :16].copy())
        tip = tip._replace(start=(tip.start + piece.size) % N)
    return np.array(seen), state.wear


@pytest.fixture(scope="module")
def fine(coarse_blade):
    return march(coarse_blade, "exponential", 8 * 32)


@pytest.mark.parametrize(
    ("scheme", "coarsest", "lowest", "highest"),
    [("exponential", 8, 1.8, 2.3), ("central_differences", 128, 0.8, 1.4)],
)
def test_order(coarse_blade, fine, scheme, coarsest, lowest, highest):
    steps = coarsest * 2 ** np.arange(4)
    errors = np.array(
        [
            [
                np.linalg.norm(found - exact) / np.linalg.norm(exact)
                for found, exact in zip(run, fine, strict=True)
            ]
            for run in (march(coarse_blade, scheme, n) for n in steps)
        ]
    )
    orders = -np.polyfit(np.log(steps), np.log(errors), 1)[0]
    print(f"{scheme}: order {orders[0]:.2f} in displacement, {orders[1]:.2f} in wear; errors {errors[:, 0]}")
    assert np.all(orders > lowest)
    assert np.all(orders < highest)
