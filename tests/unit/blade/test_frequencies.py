import numpy as np
import pytest

from bladerub.blade.frequencies import reduced_frequencies


def test_reduced_frequencies_are_those_of_the_oscillators(oscillators):
    expected = np.sqrt(np.arange(1, 6) ** 2 + 100 * 0.3**2 / (2 * np.pi) ** 2)
    np.testing.assert_allclose(reduced_frequencies(oscillators, 0.3, 5), expected, rtol=1e-12)
    assert reduced_frequencies(oscillators, 0.0)[-1] == pytest.approx(30.0)
