import threading
import time

import pytest

from bladerub.study.solver import each_done


def test_one_thread_is_the_caller_s_and_computes_on_demand():
    began = []
    done = each_done(lambda item: began.append((item, threading.current_thread())), [1, 2, 3], 1)
    next(done)
    assert began == [(1, threading.current_thread())]


def test_as_many_are_computed_at_once_as_there_are_threads():
    together = threading.Barrier(3, timeout=10)
    assert len(list(each_done(lambda item: together.wait(), range(6), 3))) == 6


@pytest.mark.parametrize("threads", [1, 2])
def test_after_an_error_none_is_begun(threads):
    began = []

    def compute(item):
        began.append(item)
        if item == 1:
            raise ValueError("first")
        time.sleep(0.2)

    with pytest.raises(ValueError, match="first"):
        list(each_done(compute, range(1, 30), threads))
    assert len(began) <= 1 + 2 * (threads - 1)
