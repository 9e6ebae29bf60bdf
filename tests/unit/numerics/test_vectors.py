"""Vectors in compiled code, and in memory, against NumPy, lane by lane."""

import itertools
from typing import NamedTuple

import numpy as np
import pytest
from numba import njit

from bladerub.numerics import lanes, memory, vectors
from bladerub.numerics.memory import addresses, aligned
from bladerub.numerics.vectors import LANES


class Data(NamedTuple):
    a: np.ndarray
    b: np.ndarray
    out: np.ndarray
    number: float


@pytest.fixture(scope="module")
def data():
    rng = np.random.default_rng(1)
    return aligned(Data(rng.normal(size=(8, LANES)), rng.normal(size=LANES), np.zeros(LANES), 0.3))


def vector_of(function):
    """Compile a function of the first row of `a`, of `b` and of the number; its result is an array."""
    compiled = njit(function)

    @njit
    def call(data):
        a, b = memory.load(data.a, 0), memory.load(data.b, 0)
        memory.store(data.out, 0, compiled(a, b, data.number))

    def result(data):
        call(addresses(data))
        return data.out.copy()

    return result


@pytest.mark.parametrize(
    ("function", "expected"),
    [
        (lambda a, b, c: (a + b) * (c - a) / (2 + b * b), lambda a, b, c: (a + b) * (c - a) / (2 + b * b)),
        (lambda a, b, c: vectors.minimum(a, b), lambda a, b, c: np.minimum(a, b)),
        (lambda a, b, c: vectors.maximum(a, c), lambda a, b, c: np.maximum(a, c)),
        (lambda a, b, c: vectors.sqrt(vectors.absolute(a)), lambda a, b, c: np.sqrt(np.abs(a))),
        (lambda a, b, c: vectors.where(a > b, a, c), lambda a, b, c: np.where(a > b, a, c)),
        (
            lambda a, b, c: vectors.where((a > b) & (b <= c), a, b),
            lambda a, b, c: np.where((a > b) & (b <= c), a, b),
        ),
    ],
    ids=["arithmetic", "lower", "higher", "root of magnitude", "choose", "both"],
)
def test_lane_by_lane(data, function, expected):
    found = vector_of(function)(data)
    np.testing.assert_allclose(found, expected(data.a[0], data.b, data.number), rtol=1e-15)


def test_sums_and_extremes_over_the_lanes(data):
    @njit
    def over(data):
        a = memory.load(data.a, 0)
        return vectors.lane_sum(a), vectors.smallest_lane(a), vectors.largest_lane(a)

    a = data.a[0]
    assert over(addresses(data)) == (pytest.approx(a.sum(), rel=1e-14), a.min(), a.max())


def test_a_condition_holds_everywhere_or_not(data):
    @njit
    def over(data):
        return vectors.all_lanes(memory.load(data.a, 0) <= 0.5)

    assert over(addresses(aligned(data._replace(a=np.zeros((1, LANES))))))
    for lane, value in itertools.product(range(LANES), (1.0, np.nan)):
        values = np.zeros((1, LANES))
        values[0, lane] = value
        assert not over(addresses(aligned(data._replace(a=values))))


def test_aligned_records_keep_what_is_in_them():
    odd = np.arange(64.0).reshape(8, 8)[:, ::2].T  # neither contiguous nor aligned
    record = aligned(Data(odd, odd[0], np.zeros(3), 1.5))
    assert np.array_equal(record.a, odd)
    assert record.number == 1.5
    for array in record[:3]:
        assert array.flags.c_contiguous
        assert array.ctypes.data % 64 == 0


def test_lanes_are_the_next_power_of_two_from_eight_on():
    assert [lanes.lanes_for(n_nodes) for n_nodes in (4, 8, 9, 16, 17, 32)] == [8, 8, 16, 16, 32, 32]
