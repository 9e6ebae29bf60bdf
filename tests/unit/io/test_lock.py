import pytest

from bladerub.io import lock

HOLDER = """
import sys, time
from bladerub.io import lock
with lock.held(sys.argv[1], lambda: None):
    print("held", flush=True)
    time.sleep(float(sys.argv[2]))
"""


@pytest.fixture
def holder(python_at_work, tmp_path):
    """Start a process that holds the lock for some seconds."""
    return lambda seconds: python_at_work(HOLDER, tmp_path / "lock", seconds)


def test_a_free_lock_is_held_without_waiting(tmp_path):
    waited = []
    for _ in range(2):
        with lock.held(tmp_path / "folder" / "lock", lambda: waited.append(1)):
            pass
    assert waited == []


def test_who_comes_second_waits_for_the_end(tmp_path, holder):
    process, waited = holder(1), []
    with lock.held(tmp_path / "lock", lambda: waited.append(process.poll())):
        assert process.wait(timeout=5) == 0
    assert waited == [None]


def test_a_killed_holder_leaves_no_lock(tmp_path, holder):
    process, waited = holder(60), []
    process.kill()
    process.wait()
    with lock.held(tmp_path / "lock", lambda: waited.append(1)):
        pass
    assert waited == []


def test_joining_tells_whether_somebody_else_is_there(tmp_path):
    first, alone = lock.share(tmp_path / "lock")
    assert alone
    second, alone = lock.share(tmp_path / "lock")
    assert not alone
    first.close()
    second.close()
    third, alone = lock.share(tmp_path / "lock")
    assert alone
    third.close()


def test_where_there_are_no_locks_work_goes_on(tmp_path, monkeypatch):
    def unsupported(*_):
        raise OSError(38, "Function not implemented")

    monkeypatch.setattr(lock.fcntl, "flock", unsupported)
    done = []
    with lock.held(tmp_path / "lock", lambda: None):
        done.append(1)
    stream, alone = lock.share(tmp_path / "lock")
    stream.close()
    assert (done, alone) == ([1], False)
