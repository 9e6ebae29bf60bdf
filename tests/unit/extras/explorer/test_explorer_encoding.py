import numpy as np
import pytest

from bladerub.extras.explorer.encoding import (
    differences,
    linear_steps,
    logarithmic_steps,
)


@pytest.fixture
def rng():
    return np.random.default_rng(5)


def test_linear_steps_keep_each_row_to_half_a_step(rng):
    values = rng.random((4, 300)) * [[1e-6], [1.0], [1e3], [0.0]]
    steps, greatest = linear_steps(values)
    assert steps.dtype == np.uint8
    np.testing.assert_array_equal(greatest, values.max(axis=1))
    back = steps / 255 * greatest[:, None]
    assert (np.abs(back - values) <= greatest[:, None] / 510 * (1 + 1e-9)).all()


def test_differences_add_up_to_the_steps(rng):
    steps = rng.integers(0, 256, (3, 50), dtype=np.uint8)
    np.testing.assert_array_equal(np.cumsum(differences(steps), axis=1, dtype=np.uint8), steps)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_logarithmic_steps_keep_values_to_half_a_ratio(rng, dtype):
    values = 10 ** rng.uniform(-8, -2, 1000)
    steps = logarithmic_steps(values, 1e-8, 1e-2, dtype)
    n_steps = np.iinfo(dtype).max - 1
    back = 1e-8 * 1e6 ** ((steps - 1.0) / n_steps)
    assert steps.dtype == dtype
    assert np.abs(np.log(back / values)).max() <= np.log(1e6) / n_steps / 2 * (1 + 1e-6)
