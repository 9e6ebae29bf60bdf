import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from bladerub.numerics.once import once


def test_threads_that_ask_together_share_one_value():
    asked, together = [], threading.Barrier(4)

    @once(maxsize=8)
    def slowly(number):
        asked.append(number)
        time.sleep(0.05)
        return object()

    def ask(_):
        together.wait()
        return slowly(3)

    with ThreadPoolExecutor(4) as pool:
        first, *others = pool.map(ask, range(4))
    assert all(other is first for other in others)
    assert asked == [3]


def test_after_an_error_the_value_is_asked_for_again():
    @once(maxsize=2)
    def inverse(number):
        return 1 / number

    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            inverse(0)
    assert inverse(2) == 0.5
