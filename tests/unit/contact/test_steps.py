import dataclasses
import math
from dataclasses import replace

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from bladerub.contact import setup
from bladerub.contact.modes import Modes, mode_shapes_at, modes_at
from bladerub.contact.schemes import Contact
from bladerub.contact.steps import BOUNCE, PASSAGE, STABLE_PART, bounce, steps_per_element
from bladerub.extras.law_reading import described_law
from bladerub.extras.turning.motion import further

MASS, STIFFNESS = 1e-3, 2e7


@pytest.fixture
def mass():
    """A tip of one node on springs so weak that it is free: radial and tangential motion."""
    return Modes(np.full(2, 1e-3), np.eye(2) / math.sqrt(MASS), 1)


def contact(stiffness=STIFFNESS):
    return Contact(np.array([stiffness]), -1.0, 0.0)


@pytest.fixture
def by_tolerance(spec, change):
    """Make a run whose step follows from a tolerance."""
    return lambda **values: change(spec, **{"steps_per_element": 0, "max_time_step": math.inf, **values})


def test_a_free_mass_bounces_with_the_frequency_of_its_spring(mass):
    step = 1e-6
    assert bounce(mass, contact(), step) == pytest.approx((step / 2) ** 2 * STIFFNESS / MASS)


def test_a_fast_mode_yields_by_its_static_displacement(mass):
    fast = mass._replace(omega=np.full(2, 1e9))
    assert bounce(fast, contact(), 1e-3) == pytest.approx(STIFFNESS / MASS / 1e18, rel=1e-6)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-2, 4e-2])
@pytest.mark.parametrize("stiffness", [1e3, 2e7, 8e8])
def test_as_few_steps_as_both_limits_allow(by_tolerance, mass, tolerance, stiffness):
    run, passage = by_tolerance(tolerance=tolerance), 1.3e-5
    n = steps_per_element(run, mass, contact(stiffness), passage)
    fewest = math.ceil(PASSAGE / math.sqrt(tolerance) - 1e-9)
    needed = passage / 2 * math.sqrt(stiffness / MASS / (BOUNCE * tolerance))
    assert n == max(fewest, math.ceil(needed))


def test_a_law_that_depends_on_the_rate_is_of_first_order(blade, by_tolerance):
    run = by_tolerance(E=0.01, tolerance=1e-2)
    viscous = replace(run.coating, element_law=described_law("viscoplastic", {"viscosity": 1e4}))
    steps = [
        setup.fixed_steps(blade, each).steps_per_element for each in (run, replace(run, coating=viscous))
    ]
    assert steps == [6, 36]


def test_central_differences_are_stable(blade, by_tolerance):
    run = by_tolerance(scheme="central_differences")
    rule, _ = setup.set_up(blade, run)
    assert rule.omega[-1] * rule.time_step <= 2 * STABLE_PART


def test_modes_diagonalise_the_blade_and_give_its_static_tip_compliance(blade):
    modes = modes_at(blade, 0.3)
    compliance = (modes.tip / modes.omega**2) @ modes.tip.T
    load = np.zeros(30)
    load[:3] = blade.radial_direction[0]
    u = np.linalg.solve(blade.stiffness(0.3), load)
    radial = np.einsum("ja,ja->j", blade.radial_direction, u[:24].reshape(8, 3))
    tangential = np.einsum("ja,ja->j", blade.tangential_direction, u[:24].reshape(8, 3))
    np.testing.assert_allclose(compliance[0], np.concatenate([radial, tangential]), rtol=1e-9, atol=1e-16)


def test_turn_of_the_whole_blade_about_the_axis_tilts_no_profile(blade, spec):
    """The tip's slope is minus the angle then, and the normal of the casing turns with the nodes."""
    _, y, z = blade.node_position.T
    turn = np.concatenate([np.column_stack([0 * y, z, -y]).ravel(), np.zeros(6)])
    turning = dataclasses.replace(blade, tip_slope=-np.outer(np.ones(8), turn) / (turn @ turn))
    np.testing.assert_allclose(further(turning, turn[:, None], spec), 0.0, rtol=0, atol=1e-12)
    along = dataclasses.replace(blade, tip_slope=np.zeros((8, turn.size)))  # it moves and does not turn
    width = 2 * np.pi * 0.65 / spec.coating.n_elements
    np.testing.assert_allclose(further(along, turn[:, None], spec), width)


def test_the_shapes_do_not_depend_on_the_threads_of_who_asks_first(blade):
    found = []
    for threads in (1, 2):
        with threadpool_limits(threads, "blas"):
            unknown = dataclasses.replace(blade)  # another one, whose modes were not asked for
            found.append(mode_shapes_at(unknown, 0.3))
    for one, other in zip(*found, strict=True):
        np.testing.assert_array_equal(one, other)
