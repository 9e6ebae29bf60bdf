"""Sobol indices by chaos expansion against closed forms.

For independent factors uniform on [0, 1], f = a (x1 - 1/2) + b (x2 - 1/2) (x3 - 1/2) has the variance
a²/12 + b²/144, of which x1 alone takes a²/12, and x2 and x3 take b²/144 together and nothing alone (Saltelli
et al. 2008, Global Sensitivity Analysis: The Primer, ch. 4).
"""

import numpy as np
import pytest
from scipy.stats import qmc

from bladerub.extras.variations.robustness import indices


@pytest.fixture
def places():
    return qmc.Sobol(5, rng=np.random.default_rng(2)).random(256)


def test_indices_of_a_sum_and_a_product(places):
    a, b = 1.0, 3.0
    centred = places - 0.5
    found = indices(places, a * centred[:, 0] + b * centred[:, 1] * centred[:, 2])
    alone, together = a**2 / 12, b**2 / 144
    first = np.array([alone, 0, 0, 0, 0]) / (alone + together)
    total = np.array([alone, together, together, 0, 0]) / (alone + together)
    assert found.first == pytest.approx(first, abs=0.01)
    assert found.total == pytest.approx(total, abs=0.01)
    assert found.predicted > 0.99


@pytest.mark.parametrize("seed", range(4))
def test_what_noise_takes_is_given_to_no_factor(places, seed):
    noise = np.random.default_rng(seed).standard_normal(256) / np.sqrt(12)
    alone = indices(places, noise)
    assert max(alone.predicted, *alone.total) < 0.05
    found = indices(places, places[:, 0] + noise)  # half of the variance each
    assert found.total[0] == pytest.approx(0.5, abs=0.15)
    assert found.total[1:].max() < 0.15


def test_of_a_threshold_most_is_predicted(places):
    found = indices(places, (places[:, 3] > 0.7).astype(float))
    assert 0.5 < found.total[3] <= found.predicted < 1
    assert found.total[[0, 1, 2, 4]].max() < 0.1


@pytest.mark.parametrize("output", [np.ones(256), np.arange(15.0)])
def test_where_nothing_varies_or_few_are_there_nothing_is_told(places, output):
    found = indices(places[: output.size], output)
    assert np.isnan(found.first).all()
    assert np.isnan(found.total).all()
    assert np.isnan(found.predicted)
