import math
from dataclasses import replace

import numpy as np
import pytest

from bladerub.extras.verification.differences import UNBOUNDED, Differences, differences


@pytest.fixture
def compare(config):
    return lambda outcome, reference: differences([outcome], [reference], config["analysis"])


def test_each_difference_is_relative_to_the_reference_and_of_wear_at_its_place(make_result, compare):
    reference = make_result(amplitude=1e-3, depth=2e-4)
    found = compare(make_result(amplitude=1.02e-3, depth=2.1e-4), reference)
    assert found == pytest.approx(Differences(wear_l2=0.05, peak=0.02, revolution_peak=0.02))
    turned = replace(
        reference, wear=np.roll(reference.wear, 1000 // 6, axis=1)
    )  # into the valleys of 6 lobes
    assert compare(turned, reference).wear_l2 == pytest.approx(math.sqrt(2), rel=0.01)


@pytest.mark.parametrize(("first", "second"), [(None, 3), (3, None), (3, 3)])
def test_nothing_is_said_of_an_unbounded_run(make_result, compare, first, second):
    assert compare(make_result(complete=first), make_result(complete=second)) == UNBOUNDED


def test_the_peaks_of_a_row_are_related_to_the_blade_that_vibrates_most(make_result, config):
    def row(large, small):
        wear = make_result(depth=2e-4)
        return [replace(make_result(amplitude=of), wear=wear.wear) for of in (small, large)]

    found = differences(row(1e-3, 2e-5), row(1e-3, 1e-5), config["analysis"])
    assert found == pytest.approx(Differences(0.0, 0.01, 0.01), rel=1e-6)
    one = row(1e-3, 1e-5)[0]
    assert differences([one], [one], config["analysis"]) == Differences(0.0, 0.0, 0.0)
