import threading

import pytest

from bladerub.io import lock

HOLDER = """
import sys
from bladerub.io import lock
with lock.held(sys.argv[1], lambda: None):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(python_at_work, tmp_path):
    """A process that holds the lock until its input is closed."""
    return python_at_work(HOLDER, tmp_path / "lock")


def test_the_second_to_ask_waits_until_the_first_is_done(tmp_path, holder):
    waited = []

    def release():
        waited.append(holder.poll())
        holder.stdin.close()

    with lock.held(tmp_path / "lock", release):
        assert holder.wait(timeout=60) == 0
    assert waited == [None]


def test_the_second_to_ask_gets_no_further_before(tmp_path):
    waits, holds = threading.Event(), threading.Event()

    def hold():
        with lock.held(tmp_path / "lock", waits.set):
            holds.set()

    second = threading.Thread(target=hold)
    with lock.held(tmp_path / "lock", lambda: None):
        second.start()
        assert waits.wait(timeout=60)
        assert not holds.wait(timeout=0.2)
    second.join(timeout=60)
    assert holds.is_set()


def test_a_killed_holder_leaves_no_lock(tmp_path, holder):
    waited = []
    holder.kill()
    holder.wait()
    with lock.held(tmp_path / "lock", lambda: waited.append(1)):
        pass
    assert waited == []
