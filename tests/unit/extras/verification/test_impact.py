import dataclasses

import numpy as np
import pytest

from bladerub.contact.modes import Modes
from bladerub.extras.verification import impact

impact._march.enable_caching()  # as in tests/validation/test_rotor37_reference.py: one of both compiles it
OMEGA, DISTANCE = 2 * np.pi * 50.0, 1e-3
MODES = Modes(np.array([OMEGA]), np.repeat([[1.0], [0.0]], 8, axis=0), 8)


@pytest.fixture
def run(blade, spec):
    """A run of a blade that moves as a whole against a round casing which it touches at rest."""
    round_one = {"nodal_diameters": (2,), "weights": (1.0,), "amplitude": 1e-14, "interference": 0.0}
    casing = dataclasses.replace(spec.casing, **round_one)
    f_omega = 10.0 / blade.f1_hz  # ten turns a second: one has five periods
    values = {"f_omega": f_omega, "revolutions": 1, "steps_per_element": 20, "clearance": (0.0, 0.0)}
    return dataclasses.replace(spec, casing=casing, initial_displacement=-DISTANCE, **values)


def turning_points(motion):
    u = motion.radial_displacement
    low = (u[1:-1] < u[:-2]) & (u[1:-1] <= u[2:]) & (u[1:-1] < -1e-6)
    return -u[1:-1][low]


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_each_impact_keeps_its_share_of_the_velocity(run, blade, restitution):
    rule = impact.moreau_jean(MODES, 0.0, impact.time_step(blade, run), restitution)
    motion = impact.simulate(rule, blade, run)
    if restitution == 0:  # it stays at the wall
        half = motion.radial_displacement.size // 2
        assert np.abs(motion.radial_displacement[half:]).max() < 0.01 * DISTANCE
    else:  # and has twice as many flights as without it
        expected = DISTANCE * restitution ** np.arange(1, 9)
        np.testing.assert_allclose(turning_points(motion)[:8], expected, rtol=0.03)


def test_a_stiff_spring_returns_the_velocity(run, blade):
    run = dataclasses.replace(run, steps_per_element=400)  # the force acts at the end of a step: it damps
    rule = impact.penalty(MODES, 0.0, impact.time_step(blade, run), 50 * OMEGA**2)
    found = turning_points(impact.simulate(rule, blade, run))
    np.testing.assert_allclose(found[:8], DISTANCE, rtol=0.03)
