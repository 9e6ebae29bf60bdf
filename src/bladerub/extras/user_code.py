"""Code of a user, such as a law, run so that neither its errors nor its loops end or hold up the program."""

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager

LONGEST_CALL = 20.0
"""Time after which code of a user is taken for endless, s."""


@contextmanager
def bounded(what: str, seconds: float = 0.0) -> Iterator[None]:
    """Run code of a user in this context; `what` names it.

    Raises `ValueError` instead of whatever that code raises, `SystemExit` included, and if it has not ended
    after some seconds, by default `LONGEST_CALL`. Only Python code can be interrupted.
    """
    thread, lock, inside, longest = threading.get_ident(), threading.Lock(), True, seconds or LONGEST_CALL

    def interrupt() -> None:
        with lock:
            if inside:
                ctypes.pythonapi.PyThreadState_SetAsyncExc(
                    ctypes.c_ulong(thread), ctypes.py_object(TimeoutError)
                )

    timer = threading.Timer(longest, interrupt)
    timer.daemon = True
    timer.start()
    try:
        yield
    except TimeoutError:
        raise ValueError(f"{what} does not end within {longest:g} s") from None
    except (Exception, SystemExit) as error:
        first_line = str(error).strip().partition("\n")[0]
        if first_line.startswith("The truth value of an array"):
            first_line = "if, and, or and not are for single numbers; where(condition, a, b) is for arrays"
        raise ValueError(f"{what} raises {type(error).__name__}: {first_line}") from error
    finally:
        with lock:
            inside = False
        timer.cancel()
