"""The step that follows from a tolerance."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bladerub.contact import setup
from bladerub.contact.laws import described_law
from bladerub.contact.modes import Modes
from bladerub.contact.schemes import Contact
from bladerub.contact.steps import BOUNCE, PASSAGE, STABLE_PART, bounce, steps_per_element

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
