"""One mass on one elastic bar: damping and stability limit of the paper's explicit scheme.

With the contact force taken at the predicted position, a mass m on a bar of stiffness k moves by
``u⁺ = (1 − κ)(2u − u⁻)``, κ = h² k / m: the roots have modulus √(1 − κ) (artificial damping) and one
leaves the unit circle at κ = 4/3. A weak spring of ratio β = h² k_s / m, which presses the mass on the
bar, moves the limit to 1 + 1 / (3 − β). (Analysis of the recurrence; the scheme is that of Legrand,
Batailly and Pierre, J. Comput. Nonlinear Dyn. 7 (2012), section 3.)
"""

import numpy as np
import pytest
from loop_by_hand import simulation

from bladerub.contact.modes import Modes
from bladerub.contact.schemes import Contact, central_differences, exponential

M, H, N = 0.1, 1e-6, 64
BETA = 1e-4
DEPTH = 1e-3
SPEED = 0.1


def mass_on_bar(spring, bar, scheme):
    """Return the scheme for the mass on a weak `spring`, its contact with the bar, its mode at the tip."""
    tip_modes = np.zeros((16, 1))
    tip_modes[0, 0] = M**-0.5
    contact = Contact(np.full(8, bar), -1.0, 0.0)
    return (
        scheme(Modes(np.array([np.sqrt(spring / M)]), tip_modes, 8), 0.0, H, contact),
        contact,
        tip_modes[0, 0],
    )


def deviations(kappa, n_revolutions=2, start=1e-8, scheme=central_differences):
    """Run the compiled loop from a small deviation about the equilibrium on the bars."""
    spring, bar = BETA * M / H**2, kappa * M / H**2
    rule, contact, mode = mass_on_bar(spring, bar, scheme)
    gap = np.ones((N, 8))
    gap[:, 0] = -DEPTH
    # the paper's scheme takes the force at the prediction (1 − β) u of a resting mass
    predicted = 1 - BETA if rule.corrects else 1.0
    rest = -DEPTH * kappa / (BETA + kappa * predicted)
    loop = simulation(rule, contact, gap, per_metre=0.0, limit=1.0)
    state = loop.state
    state.q[:, 0] = (rest + start) / mode
    state.u[:, [0, 24]] = rest + start  # displacement and approach of the first node
    if not rule.corrects:  # the elements are already pressed
        state.normal_force[0, 0] = bar * (rest + start + DEPTH)
        state.force[:, 0] = -state.normal_force[0, 0]
    seen = []
    for _ in range(n_revolutions):
        displacement = np.zeros(N)
        loop.advance(displacement)
        seen.append(displacement - rest)  # the means of two steps each: the same recurrence
    return np.concatenate(seen)


@pytest.mark.parametrize("kappa", [0.05, 0.1, 0.2])
def test_contact_damps_like_the_root_of_one_less_kappa(kappa):
    """A damped recurrence of constant coefficients: u⁺ u⁻ − u² shrinks by |z|² a step."""
    u = deviations(kappa, 1)[:40]
    casoratian = u[2:] * u[:-2] - u[1:-1] ** 2
    modulus = np.sqrt(casoratian[1:] / casoratian[:-1])
    np.testing.assert_allclose(modulus, np.sqrt(1 - kappa), rtol=2e-3)


@pytest.mark.parametrize(("factor", "grows"), [(0.97, False), (1.03, True)])
def test_scheme_is_unstable_above_four_thirds(factor, grows):
    limit = 1 + 1 / (3 - BETA)
    assert limit == pytest.approx(4 / 3, rel=1e-4)
    u = np.abs(deviations(factor * limit, start=1e-11))
    ratio = u[110:118].max() / u[10:18].max()
    assert ratio > 100 if grows else ratio < 0.01


@pytest.mark.parametrize("kappa", [0.05, 0.2, 0.9])
def test_exponential_scheme_does_not_damp_contact(kappa):
    """u⁺ = (2 − κ) u − u⁻: the roots have modulus 1 and the phase 2 asin(√κ / 2)."""
    u = deviations(kappa, 1, scheme=exponential)[1:41]
    casoratian = u[2:] * u[:-2] - u[1:-1] ** 2
    np.testing.assert_allclose(casoratian / casoratian[0], 1.0, rtol=2e-3)
    cosine = (u[2:] + u[:-2]) @ u[1:-1] / (2 * u[1:-1] @ u[1:-1])
    assert np.arccos(cosine) == pytest.approx(2 * np.arcsin(np.sqrt(kappa) / 2), rel=1e-3)


@pytest.mark.parametrize("hardening", [1e12, 0.5])
def test_errors_of_a_bounce_average_out(hardening):
    """In the mean over the phase of the first contact; plastic bars return ``K / (E + K)`` of the energy."""
    # κ = 0.13, and a spring too weak to matter
    rule, contact, mode = mass_on_bar(M, 4 * 0.13 * M / H**2, exponential)
    gap = np.ones((N, 8))
    gap[:, 0] = 10 * SPEED * H
    after = []
    for phase in np.arange(24) / 24:
        loop = simulation(rule, contact, gap, hardening, steps=1000, per_metre=0.0, limit=1.0)
        positions = SPEED * H * (phase - np.arange(3))
        loop.state.q[:, 0] = positions / mode
        loop.state.u[:, [0, 24]] = positions[:, None]
        loop.advance(np.zeros(1))
        after.append((loop.state.q[0, 0] - loop.state.q[1, 0]) * mode / (SPEED * H))
    errors = np.array(after) + np.sqrt(hardening / (1 + hardening))
    print(f"K / E = {hardening:g}: mean {errors.mean():.4f}, scatter {errors.std():.4f}")
    assert 0.01 < errors.std() < 0.05
    assert abs(errors.mean()) < 0.1 * errors.std()
