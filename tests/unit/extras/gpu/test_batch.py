"""Runs are packed for a device: what they share once, what it can't do not at all."""

import math

import pytest

from bladerub.contact.setup import set_up
from bladerub.contact.spec import ElementLaw
from bladerub.extras.gpu import batch
from bladerub.extras.gpu.batch import pack, refusal, variant_of

HEATED = {
    "heat_capacity": 1e6,
    "conductivity": 1.0,
    "heated_depth": 1e-4,
    "friction_share": 0.5,
    "softening_rise": 500.0,
    "softening_exponent": 1.0,
}


def packed(blade, specs):
    simulations = [set_up(blade, spec)[1] for spec in specs]
    return pack(variant_of(specs[0], simulations[0]), simulations)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"E": math.inf, "K": math.inf}, "rigid casing"),
        ({"law": "coulomb"}, "Coulomb"),
        ({"scheme": "central_differences", "max_time_step": 2e-6}, "central_differences corrects"),
        ({"element_law": ElementLaw("thermal", tuple(HEATED.items()))}, "thermal conducts heat"),
        ({}, ""),
    ],
)
def test_what_the_loop_can_not_do_is_said(values, reason, blade, spec, change):
    changed = change(spec, **values)
    told = refusal(changed, set_up(blade, changed)[1])
    assert reason in told
    assert bool(told) == bool(values)


def test_the_window_of_elements_is_wide_enough(blade, spec, change):
    for half_width in (1.0, 2.0, 2.5, 3.0, 6.0):
        changed = change(spec, half_width=half_width)
        rows = 4 * variant_of(changed, set_up(blade, changed)[1]).rows
        farthest = rows - 2 * half_width - 1.5  # as in ``loop.cu``
        assert math.floor(2 * half_width + farthest) + 2 <= rows  # at the worst place
        assert farthest >= 0.5


def test_runs_of_other_profiles_and_sizes_have_the_same_program(blade, spec, change):
    """It is compiled for each: the robustness draws both for each of its samples."""

    def source_for(**changes):
        changed = change(spec, **changes)
        return batch.source(variant_of(changed, set_up(blade, changed)[1]))

    same = source_for(half_width=1.2)
    assert source_for(half_width=1.3) == same
    assert source_for(half_width=1.2, n_elements=1500, revolutions=3) == same
    assert source_for(half_width=2.6) != same
