"""Code of a user, such as a law, run so that neither its errors nor its loops end or hold up the program."""

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager

LONGEST_CALL = 20.0  # s, after which code of a user is taken for endless


@contextmanager
def bounded(what: str, seconds: float = 0.0) -> Iterator[None]:
    """Run code of a user, `what`, in this context.

    Raises `ValueError` instead of whatever that code raises, `SystemExit` included, and if it has not ended
    after some seconds, by default `LONGEST_CALL`. Only Python code can be interrupted.
    """
    lock, inside, longest = threading.Lock(), True, seconds or LONGEST_CALL
    thread, late = ctypes.c_ulong(threading.get_ident()), ctypes.py_object(TimeoutError)

    def interrupt() -> None:
        with lock:
            if inside:
                ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, late)

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
