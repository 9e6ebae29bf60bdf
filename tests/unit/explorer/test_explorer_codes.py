import base64
import gzip

import numpy as np
import pytest

from bladerub.explorer.codes import differences, linear, log_range, logarithmic, packed


@pytest.fixture
def rng():
    return np.random.default_rng(5)


def test_linear_codes_keep_each_row_to_half_a_step(rng):
    values = rng.random((4, 300)) * [[1e-6], [1.0], [1e3], [0.0]]
    codes, greatest = linear(values)
    assert codes.dtype == np.uint8
    np.testing.assert_array_equal(greatest, values.max(axis=1))
    back = codes / 255 * greatest[:, None]
    assert (np.abs(back - values) <= greatest[:, None] / 510 * (1 + 1e-9)).all()


def test_differences_add_up_to_the_codes(rng):
    codes = rng.integers(0, 256, (3, 50), dtype=np.uint8)
    np.testing.assert_array_equal(np.cumsum(differences(codes), axis=1, dtype=np.uint8), codes)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_logarithmic_codes_keep_values_to_half_a_ratio(rng, dtype):
    values = 10 ** rng.uniform(-8, -2, 1000)
    codes = logarithmic(values, 1e-8, 1e-2, dtype)
    steps = np.iinfo(dtype).max - 1
    back = 1e-8 * 1e6 ** ((codes - 1.0) / steps)
    assert codes.dtype == dtype
    assert np.abs(np.log(back / values)).max() <= np.log(1e6) / steps / 2 * (1 + 1e-6)


def test_no_value_and_values_beyond_the_ends_have_their_codes():
    codes = logarithmic(np.array([np.nan, 0.0, 1e-9, 1e-8, 1e-2, 1.0]), 1e-8, 1e-2, np.uint8)
    assert codes.tolist() == [0, 1, 1, 1, 255, 255]


@pytest.mark.parametrize(
    ("values", "ends"),
    [
        ([np.nan, 0.0, 1e-3, 1e-1], (1e-3, 1e-1)),
        ([1e-3, 1.1e-3], (1e-3, 2e-3)),
        ([np.nan, 0.0], (1e-9, 2e-9)),
    ],
)
def test_a_range_holds_what_is_above_the_floor(values, ends):
    assert log_range(np.array(values), 1e-9) == pytest.approx(ends)


def test_packed_data_come_back_and_equal_data_give_equal_text(rng):
    data = rng.bytes(1000)
    assert gzip.decompress(base64.b64decode(packed(data))) == data
    assert packed(data) == packed(data)
