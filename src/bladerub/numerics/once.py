"""A cache for threads that ask for the same at the same time."""

import threading
from collections.abc import Callable
from functools import lru_cache, wraps
from typing import Any


def once(maxsize: int) -> Callable[[Callable], Callable]:
    """Keep the last `maxsize` values of a function; one thread computes, the others wait for its value."""

    def decorate(function: Callable) -> Callable:
        cached, lock = lru_cache(maxsize)(function), threading.Lock()

        @wraps(function)
        def locked(*args: Any, **kwargs: Any) -> Any:
            with lock:
                return cached(*args, **kwargs)

        return locked

    return decorate
