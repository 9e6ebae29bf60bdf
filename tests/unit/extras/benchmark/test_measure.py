"""What the benchmark measures: shares, operations and the figures it prints."""

import pytest

from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.extras.benchmark import measure


def test_useful_operations_of_a_step(blade, spec, change):
    rule, simulation = set_up(blade, spec)
    n, flight = rule.omega.size, simulation.flight.n_steps
    free = change(spec, clearance=(1.0, 1.0))
    assert measure.useful_flops(blade, free) == pytest.approx(61 * n / flight)
    result = simulate(blade, spec)
    flops = measure.useful_flops(blade, spec) * result.n_steps
    contact = (32 * n + 512 + 8 * (5 * 69 + 60)) * result.n_contact_steps
    single = (flops - contact - 61 * n / flight * result.n_steps) / (39 * n - 61 * n / flight)
    assert result.n_contact_steps <= single < result.n_steps
    assert single == pytest.approx(round(single))
