import numpy as np
import pytest

from bladerub.contact.modes import at_tip
from bladerub.contact.setup import set_up
from bladerub.contact.spec import Coating
from bladerub.extras.export.recording import record
from bladerub.extras.rows.row import simulate_row
from bladerub.extras.rows.spec import Disk, Row


def tip_at(blade, spec, instants):
    return at_tip(blade, record(blade, spec, Row.even(1), instants).coordinates[:, 0].T)


@pytest.fixture(params=["exponential", "central_differences", "rigid"])
def in_contact(request, spec, change):
    """A run in each form of the law of contact; against the rigid casing the modes are shared out."""
    if request.param == "central_differences":
        return change(spec, scheme=request.param, max_time_step=1e-6)
    if request.param == "rigid":
        spec = change(spec, coating=Coating(np.inf, np.inf, 0.1, 1e-6, 150e6, 5e-3, 200))
    return change(spec, steps_per_element=6, max_time_step=2e-5)  # too long for the highest mode


def test_the_tip_is_where_the_run_has_it(blade, in_contact):
    tip = tip_at(blade, in_contact, [100, 200 * in_contact.revolutions])[:, -1]
    rule, simulation = set_up(blade, in_contact)
    for _ in range(in_contact.revolutions):
        simulation.advance(np.empty(200))
    assert (rule.share < 1).any() == (in_contact.scheme == "exponential")
    np.testing.assert_allclose(tip, simulation.state.u[0, :16], rtol=0, atol=1e-9 * np.abs(tip).max())


def test_contact_forces_move_what_the_scheme_does_not_resolve(blade, spec, change):
    spec = change(spec, E=20.0, revolutions=1, steps_per_element=6, max_time_step=2e-5)
    tip = tip_at(blade, spec, range(1, 201))
    rule, simulation = set_up(blade, spec)
    moved = 0
    for element in range(200):
        simulation.advance(np.empty(1), element)
        np.testing.assert_allclose(tip[:, element], simulation.state.u[0, :16], rtol=0, atol=1e-12)
        static = rule.static_compliance @ simulation.state.force[0, :16]
        moved += np.abs(static).max() > 1e-9
    assert moved > 5


def test_a_row_moves_and_wears_as_in_its_run(blade, spec, change):
    spec = change(spec, E=2.0, revolutions=3)
    row = Row.even(2, length=[0.0, 2e-5], frequency=[0.0, 0.01], disk=Disk.ring(2, [1e-3]))
    recording = record(blade, spec, row, range(401, 601))
    whole = simulate_row(blade, spec, row)
    assert whole.wear.any()
    np.testing.assert_array_equal(recording.time, np.arange(401, 601) / 200)
    np.testing.assert_array_equal(recording.wear[-1], whole.wear)
    np.testing.assert_array_equal(recording.revolution_peak, [of.revolution_peak for of in whole.blades])
    for number, of in enumerate(whole.blades):
        tip = at_tip(blade, recording.coordinates[:, number].T)[0]
        between = 0.5 * (tip[1:] + tip[:-1])  # of a coarse ring
        means = of.radial_displacement[401:]
        np.testing.assert_allclose(between, means, rtol=0, atol=0.06 * np.abs(means).max())
