"""What the time loop gets, against a brute-force search."""

import dataclasses

import numpy as np
import pytest
import scipy.linalg
from stand_in import made_blade

from bladerub.contact import setup
from bladerub.contact.kernel import loop
from bladerub.contact.start import SEARCH_RANGE, Seat, minimum_gap, tip_record
from bladerub.contact.strips import by_angle

N = 200
UNEVEN = np.array([-0.023, -0.021, -0.016, -0.015, -0.002, 0.011, 0.013, 0.024])
"""Axial position of the nodes, m."""
RECORDS = ("modal", "flight", "stator", "tip", "state")


def lowest_met(rows, half_width, element):
    """Smallest gap under a node in the passage of an element, wherever it starts and is displaced to."""
    edge = 1.0 - 1e-9
    met = [
        np.arange(np.floor(position - half_width), np.floor(position + half_width) + 1).astype(int)
        for start in (0.0, edge)
        for passed in (0.0, 1.0)
        for displaced in (-SEARCH_RANGE, SEARCH_RANGE)
        for position in [start + element + passed + displaced]
    ]
    return rows[:, np.concatenate(met) % rows.shape[1]].min()


@pytest.mark.parametrize("half_width", [0.5, 2.0, 3.3])
def test_no_node_meets_less_than_the_minimum_gap(half_width):
    rows = np.random.default_rng(2).random((8, N))
    found = minimum_gap(rows, half_width)
    met = np.array([lowest_met(rows, half_width, element) for element in range(N)])
    assert (found <= met).all()
    spike = np.ones((8, N))
    spike[3, 100] = 0.0  # is seen no longer than by one element on either side of where it can be met
    seen = np.flatnonzero(minimum_gap(spike, half_width) == 0.0)
    reached = np.flatnonzero([lowest_met(spike, half_width, element) == 0.0 for element in range(N)])
    assert reached[0] - 2 <= seen[0] <= reached[0]
    assert reached[-1] <= seen[-1] <= reached[-1] + 2


def test_friction_is_limited_by_what_all_nodes_together_take(blade, spec, change):
    """γ of a node: the most that forces of ±1 N, or none, on all nodes take from its sliding."""
    _, simulation = setup.set_up(blade, change(spec, theta=0.15, law="coulomb"))
    signs = np.array(np.meshgrid(*[[-1.0, 1.0]] * 8)).reshape(8, -1)
    most = (simulation.modal.mobility[8:, 8:] @ signs).max(axis=1)
    np.testing.assert_allclose(simulation.modal.stopping, most, rtol=1e-12)


@pytest.fixture
def uneven():
    angle = 2 * UNEVEN + 0.01 * np.sin(200 * UNEVEN)
    return made_blade(np.random.default_rng(7), 192.0, UNEVEN, angle, 0.65)


def test_clearance_is_linear_along_the_chord_not_by_node(uneven, spec, change):
    spec = change(spec, interference=0.0, amplitude=1e-12)
    _, simulation = setup.set_up(uneven, spec)
    along = (UNEVEN - UNEVEN[0]) / np.ptp(UNEVEN)
    expected = spec.clearance[0] + (spec.clearance[1] - spec.clearance[0]) * along
    np.testing.assert_allclose(simulation.stator.initial_gap[0], expected, atol=1e-11)


def test_the_blade_begins_over_the_element_at_its_angle(uneven, spec):
    _, simulation = setup.set_up(uneven, spec)
    n_elements = spec.coating.n_elements
    angle = spec.casing.start_angle + np.arctan2(uneven.node_position[:, 1], uneven.node_position[:, 2])
    marked = np.zeros((n_elements, 8))
    marked[0] = 1.0  # the first row
    elements = by_angle(uneven, spec, marked).argmax(axis=1)
    np.testing.assert_array_equal(elements, np.floor(angle / (2 * np.pi) * n_elements) % n_elements)
    np.testing.assert_allclose(simulation.tip.start, angle / (2 * np.pi) * n_elements % 1.0, atol=1e-9)


@pytest.mark.parametrize(("max_time_step", "steps"), [(1.0, 12), (1e-6, 87)])
def test_the_step_is_the_longest_that_is_allowed(uneven, spec, change, max_time_step, steps):
    spec = change(spec, max_time_step=max_time_step)
    rule, simulation = setup.set_up(uneven, spec)
    passage = 1 / (spec.f_omega * uneven.f1_hz * spec.coating.n_elements)
    assert simulation.steps_per_element == steps
    assert rule.time_step == pytest.approx(passage / steps)
    assert rule.time_step <= max_time_step


@pytest.mark.parametrize("damping", [2e-3, 0.4])
def test_a_deflected_blade_has_moved_freely_until_then(blade, spec, change, damping):
    rule, simulation = setup.set_up(blade, change(spec, initial_displacement=1e-5, damping_ratio=damping))
    omega = rule.omega[0]
    motion = np.array([[0.0, 1.0], [-(omega**2), -2 * damping * omega]])
    before, _ = scipy.linalg.expm(-rule.time_step * motion) @ [1.0, 0.0]
    assert simulation.state.q[1, 0] / simulation.state.q[0, 0] == pytest.approx(before, rel=1e-12)


def test_no_node_of_a_conical_tip_is_searched_beyond_the_range(blade, spec, change):
    position = blade.node_position * np.linspace(1.0, 1.2, 8)[:, None]
    conical = dataclasses.replace(blade, node_position=position)
    fine = dataclasses.replace(change(spec, n_elements=2000), displacement_limit=0.02)
    tip = tip_record(conical, fine)
    assert (tip.search_range * tip.per_metre).max() == pytest.approx(SEARCH_RANGE)
    # a tip that is clear of the casing leaves the limit, too
    assert tip_record(conical, dataclasses.replace(spec, displacement_limit=1e-3)).search_range == 1e-3


def at_radius(blade, radius):
    position = blade.node_position.copy()
    position[:, 1:] *= radius / np.hypot(*position[:, 1:].T)[:, None]
    return dataclasses.replace(blade, node_position=position)


@pytest.mark.parametrize("seed", range(10))
def test_accepted_limits_keep_every_index_within_a_turn(blade, spec, change, seed):
    """What the loop wraps is in (-N, 2 N), and no step has a row twice, at the largest limit accepted."""
    rng = np.random.default_rng(seed)
    # under a wide tip the turn sets the limit, under others the radius
    n, radius = int(rng.integers(20, 400)), 10 ** rng.uniform(-3, 1)
    half_width = rng.uniform(0.1, 5.0) if seed % 3 else rng.uniform(0.3, 0.4) * n
    blade = at_radius(blade, radius)
    ahead = rng.random() * (seed % 2)
    accepted = 0.0
    for limit in radius * np.geomspace(1e-3, 2.0, 300):
        run = change(spec, n_elements=n, half_width=half_width, displacement_limit=limit)
        try:
            tip = tip_record(blade, run, Seat(ahead))
        except ValueError:
            continue
        accepted = limit
        reach = np.maximum(limit * tip.per_metre, SEARCH_RANGE)
        lowest, highest = (tip.start - reach).min(), (tip.start + n + reach).max()
        rows = [np.floor(lowest - half_width), np.floor(highest + half_width)]
        rigid = [np.floor(lowest) - 1, np.floor(highest) + 1]
        assert min(rows[0], rigid[0]) >= -n
        assert max(rows[1], rigid[1]) < 2 * n
        # of one step, which passes at most an element, with a node at both limits
        assert (np.floor(2 * reach + 2 * half_width + 1) + 1).max() <= n
        assert limit < tip.radius.min()
    assert accepted or n < 2 * (SEARCH_RANGE + max(half_width, 1.0)) + 6


def test_a_blade_whose_tip_may_leave_the_turn_is_refused(blade, spec):
    outwards = dataclasses.replace(blade, radial_direction=-blade.radial_direction)
    no_numbers = dataclasses.replace(blade, node_position=blade.node_position * np.nan)
    one_node = blade.node_position * np.where(np.arange(8) == 2, 1e-6, 1.0)[:, None]
    near_the_axis = dataclasses.replace(blade, node_position=one_node)
    for broken in (at_radius(blade, 1e-6), near_the_axis, outwards, no_numbers):
        with np.errstate(all="ignore"), pytest.raises(ValueError, match="displacement limit"):
            tip_record(broken, spec)


def broken_parts(part):
    """What may not be read by address in the place of an array."""
    yield part[..., :-1].copy() if part.size else np.zeros((3, 3))
    yield part.astype(np.float32)
    if part.size:
        yield np.repeat(part, 2, axis=-1)[..., ::2]
        yield np.full(part.shape, np.nan)


@pytest.mark.parametrize("kind", RECORDS)
def test_each_field_that_is_read_by_address_is_checked(blade, spec, kind):
    _, simulation = setup.set_up(blade, spec)
    records = {name: getattr(simulation, name) for name in RECORDS}
    arrays = {name: part for name, part in records[kind]._asdict().items() if isinstance(part, np.ndarray)}
    assert arrays
    for name, part in arrays.items():
        for wrong in broken_parts(part):
            bad = records | {kind: records[kind]._replace(**{name: wrong})}
            with pytest.raises(ValueError, match=rf"\.{name}: "):
                type(simulation)(*bad.values(), simulation.steps_per_element)


def test_the_loop_is_compiled_for_the_records_of_runs(blade, spec):
    setup.compile_kernel()
    _, simulation = setup.set_up(blade, spec)
    simulation.advance(np.zeros(spec.coating.n_elements))
    assert len(loop.integrate.signatures) == 1
