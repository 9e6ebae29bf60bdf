"""A GPU as what computes the runs of a study (`bladerub.study.solver`)."""

import os
from collections.abc import Callable, Iterator, Sequence
from functools import cache

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.spec import RunSpec
from bladerub.extras.gpu import ADDRESS, process
from bladerub.io import sources
from bladerub.study.solver import Solved, Solver


class Gpu(Solver):
    """Computes all runs together; the processor computes those that it does not know."""

    wants_many = True

    def simulate_many(
        self,
        blade: ReducedBlade,
        specs: Sequence[RunSpec],
        threads: int = 1,
        report: Callable[[str], None] = lambda line: None,
        progress: Callable[[int], None] | None = None,
        longer: Callable[[int, RunResult], int] | None = None,
    ) -> Iterator[Solved]:
        """Yield each run as it is done; raises `bladerub.extras.gpu.device.NoGpuError` without a GPU."""
        from bladerub.extras.gpu import many, server  # load the compiler: who plans runs alone does without

        results = many.simulate_many(blade, specs, server.find(), lambda left_out: report(str(left_out)))
        return (Solved(number, result, 0.0) for number, result in results)

    def determinants(self) -> dict[str, str]:
        """Digest its sources: the last bits differ from those of the processor, and so a chaotic run."""
        return {"gpu": gpu_digest()}

    def check(self) -> None:
        """Raise `bladerub.extras.gpu.device.NoGpuError` without a GPU."""
        if not os.environ.get(ADDRESS):
            from bladerub.extras.gpu import device  # loads the compiler

            device.connect()

    def start(self) -> None:
        """Start the process that has the GPU."""
        process.start_server()


@cache
def gpu_digest() -> str:
    """Digest the source of what computes a run on a GPU, besides `bladerub.contact.sources.solver_digest`."""
    folder = sources.PACKAGE / "extras" / "gpu"
    return sources.source_digest(path for path in folder.iterdir() if path.suffix in (".py", ".h", ".cu"))
