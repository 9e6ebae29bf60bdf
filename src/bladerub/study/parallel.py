"""Several runs of one job at once, in threads: the time loop holds no lock of the interpreter."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TypeVar

from threadpoolctl import threadpool_limits

Item = TypeVar("Item")
Result = TypeVar("Result")


def each_done(
    compute: Callable[[Item], Result], items: Iterable[Item], threads: int
) -> Iterator[tuple[Item, Result]]:
    """Yield each item with ``compute(item)`` as it is done, `threads` at once.

    With one thread the items are computed in this one, in their order, and each only when it is asked for.
    After an error, which is raised, or when no more are asked for, none is begun.
    """
    with threadpool_limits(1, "blas"):  # one for all: threads that come and go change each other's
        if threads == 1:
            yield from ((item, compute(item)) for item in items)
            return
        with ThreadPoolExecutor(threads) as pool:
            futures = {pool.submit(compute, item): item for item in items}
            try:
                for future in as_completed(futures):
                    yield futures[future], future.result()
            finally:
                pool.shutdown(wait=False, cancel_futures=True)
