"""Several runs at once."""

import threading
import time

import pytest

from bladerub.study.parallel import each_done


@pytest.mark.parametrize("threads", [1, 3])
def test_each_item_comes_with_its_result(threads):
    assert dict(each_done(lambda item: item**2, range(20), threads)) == {n: n**2 for n in range(20)}


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


def test_none_is_begun_after_the_last_that_is_asked_for():
    began = []

    def compute(item):
        began.append(item)
        time.sleep(0.1)

    done = each_done(compute, range(30), 2)
    next(done)
    done.close()
    assert len(began) < 10
