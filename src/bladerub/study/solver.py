"""What computes the runs of a study: many specs → many results.

It is the processor, or what a folder of `bladerub.extras` offers under another name (``SOLVERS`` of
`bladerub.plugins`); ``solver.device`` of the config names it. Rows of blades that rub on one coating, instead
of the single blade, have another (``ROWS``).
"""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import partial
from typing import Any, NamedTuple, TypeVar

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub import plugins
from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.spec import RunSpec
from bladerub.io.errors import BadInput
from bladerub.settings.study import Config

ROW = "rotor"  # block of the config that describes a row of blades

Item = TypeVar("Item")
Result = TypeVar("Result")


class Solved(NamedTuple):
    """A run that was computed."""

    number: int  # Of its spec
    result: RunResult
    seconds: float  # Of wall time; 0 where it has no time of its own


class Solver:
    """Computes runs of one blade on the processor; what computes them otherwise derives from this."""

    wants_many = False
    """Whether it computes runs together, and is idle where it gets a few at a time."""

    def simulate_many(
        self,
        blade: ReducedBlade,
        specs: Sequence[RunSpec],
        threads: int = 1,
        report: Callable[[str], None] = lambda line: None,
        progress: Callable[[int], None] | None = None,
        longer: Callable[[int, RunResult], int] = lambda number, result: 0,
    ) -> Iterator[Solved]:
        """Yield each run as it is done; raises as `bladerub.contact.run.simulate`.

        `threads` runs may be computed at once, `report` is called with lines for a log, and `progress` with
        the number of revolutions done of a run, where they are counted. A run may be followed by itself for
        as many revolutions as ``longer(number, result)`` says: a solver that goes on with runs yields it
        again.
        """

        def timed(number: int) -> tuple[list[RunResult], float]:
            start = time.monotonic()
            results = self.simulate_longer(blade, specs[number], partial(longer, number), progress)
            return results, time.monotonic() - start

        for number, (results, seconds) in each_done(timed, range(len(specs)), threads):
            revolutions = [result.revolution_peak.size for result in results]
            for result, more in zip(results, np.diff(revolutions, prepend=0), strict=True):
                yield Solved(number, result, seconds * more / revolutions[-1])

    def simulate_longer(self, *run: Any) -> list[RunResult]:
        """Compute a run and perhaps its longer one, as `bladerub.contact.run.simulate_longer`."""
        from bladerub.contact import run as one_run  # loads the compiler, which not all need

        return one_run.simulate_longer(*run)

    def determinants(self) -> dict[str, str]:
        """Name and digest of what determines a run besides `solver_digest`, if anything."""
        return {}

    def check(self) -> None:
        """Raise `BadInput` where what it needs is not there, before any work."""

    def start(self) -> None:
        """Begin, in the main process of a workflow, what its jobs on this machine share, if anything."""


def solver_of(config: Config) -> Solver:
    """Return what computes the runs of the study `config`; raises `BadInput` where that is not there."""
    name, offered = config.solver.device, plugins.offered("SOLVERS")
    if name == "cpu":
        return Solver()
    if name not in offered:
        names = " or ".join(["cpu", *offered])
        raise BadInput(f"solver.device = {name}: this package is without it, must be {names}")
    return plugins.load(offered[name])()


def each_done(
    compute: Callable[[Item], Result], items: Iterable[Item], threads: int
) -> Iterator[tuple[Item, Result]]:
    """Yield each item with ``compute(item)`` as it is done, `threads` at once: the loop holds no global lock.

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


def rows() -> Any:
    """Return the module that computes rows; raises `ValueError` where the package is without it.

    It has `described(config)`, `stored(run)`, `determinants(row)` and `compute(row, blade, case, spec, key,
    analysis, keep_history, progress)`. A row has ``blades``.
    """
    if ROW not in (offered := plugins.offered("ROWS")):
        raise ValueError("row: this package computes no rows of blades; must be left out")
    return plugins.load(offered[ROW])


def row_of(config: Config) -> Any:
    """Describe the row of blades of a study, None for a single one; ValueError for lists of wrong length."""
    return rows().described(config) if config.plugged(ROW) else None
