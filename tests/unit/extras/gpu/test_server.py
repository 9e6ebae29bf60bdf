"""One process computes for others, merges what they ask for at the same time, and tells them of errors."""

import threading
import time
from multiprocessing.connection import Listener

import numpy as np
import pytest

from bladerub.extras.gpu import server
from bladerub.extras.gpu.batch import Output, Work


def work_of(number, n_runs=2, source="a"):
    runs = np.full((n_runs, 5), 0, dtype=np.int32)
    record = np.full((1, 1), float(number))
    return Work(source, 1, 4, 1, record, record, record, record, runs, np.full((n_runs, 2, 1), float(number)))


def left_of(work):
    return Output(work.modes, *(np.zeros((len(work.runs), 1)) for _ in range(6)))


@pytest.fixture
def serve(tmp_path, monkeypatch):
    """Serve a device until the end of the test."""
    opened = []

    def start(run):
        address = str(tmp_path / "socket")
        opened.append(Listener(address, "AF_UNIX"))
        threading.Thread(target=server.serve, args=(opened[0], run), daemon=True).start()
        monkeypatch.setenv(server.ADDRESS, address)

    yield start
    opened[0].close()


def test_what_is_asked_for_while_the_gpu_is_busy_is_computed_together(serve):
    begun, go_on, seen = threading.Event(), threading.Event(), []

    def run(works):
        together = list(works)
        seen.append(sorted((work.source, len(work.runs)) for work in together))
        begun.set()
        go_on.wait(30)
        return map(left_of, together)

    serve(run)
    answers = {}

    def ask(number, source):
        answers[number, source] = list(server.ask([work_of(number, source=source)]))

    callers = [threading.Thread(target=ask, args=(0, "a"))]
    callers[0].start()
    assert begun.wait(30)
    callers += [threading.Thread(target=ask, args=(number, "ab"[number % 2])) for number in range(1, 7)]
    for each in callers[1:]:
        each.start()
    deadline = time.monotonic() + 30
    while threading.active_count() < 7 + 7 and time.monotonic() < deadline:  # a thread of the server for each
        threading.Event().wait(0.01)
    threading.Event().wait(0.2)  # their requests are read
    go_on.set()
    for each in callers:
        each.join(30)
    assert seen == [[("a", 2)], [("a", 2)] * 3 + [("b", 2)] * 3]
    for (number, _), (left,) in answers.items():
        assert np.all(left.modes == number)


def test_an_error_reaches_who_asked(serve):
    def run(works):
        for work in works:
            if work.source == "wrong":
                raise ValueError("no such thing")
            yield left_of(work)

    serve(run)
    with pytest.raises(ValueError, match="no such thing"):
        list(server.ask([work_of(1, source="wrong")]))
    works = [work_of(number, n_runs=number) for number in (1, 2, 3)]  # and the server goes on
    for work, left in zip(works, server.find()(works), strict=True):
        np.testing.assert_array_equal(left.modes, work.modes)
