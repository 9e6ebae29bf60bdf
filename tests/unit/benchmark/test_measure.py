"""What the benchmark measures: shares, operations and the figures it prints."""

import pytest

from bladerub.benchmark import measure, peak
from bladerub.contact.run import set_up


def test_the_casing_is_brought_near_until_a_third_is_contact(blade, spec):
    found, share = measure.in_contact(blade, spec)
    assert share == pytest.approx(1 / 3, abs=0.02)
    assert found.casing.interference > 0


def test_useful_operations_of_a_step(blade, spec):
    run = set_up(blade, spec)
    n = run.rule.omega.size
    free = measure.useful_flops(run, 0.0)
    assert free == 39 * n
    contact = measure.useful_flops(run, 1.0) - free
    assert contact == 32 * n + 3 * 512 + 8 * (5 * 69 + 60)


def test_the_peak_loop_takes_time_in_proportion():
    assert peak.turns(1) == pytest.approx(sum((1 + i / 10) * 0.999 + 0.001 for i in range(12)) * 8)
