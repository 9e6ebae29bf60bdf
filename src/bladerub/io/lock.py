"""Locks between processes that end with the process that holds them, however it ends.

They are ``flock`` locks: the kernel drops them when the last process with the file open is gone. Where a file
system has no such locks nobody is kept out; files are written whole all the same, so that only time is lost.
"""

import fcntl
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO


@contextmanager
def held(path: str | Path, on_wait: Callable[[], object]) -> Iterator[None]:
    """Hold the lock file `path`, which nobody else may hold meanwhile.

    It and its folder are made if need be, and stay. `on_wait` is called once before waiting for the lock.
    """
    stream = attempt(path)
    if stream is None:
        stream = _opened(path)
        with suppress(OSError):  # a log on a full disk
            on_wait()
        with suppress(OSError):  # no such locks here
            fcntl.flock(stream, fcntl.LOCK_EX)
    with stream:
        yield


def attempt(path: str | Path) -> IO | None:
    """Hold the lock file `path` until the returned stream is closed; None if somebody else holds it."""
    stream = _opened(path)
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        stream.close()
        return None
    except OSError:  # no such locks here
        pass
    return stream


def _opened(path: str | Path) -> IO:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    return open(path, "a")
