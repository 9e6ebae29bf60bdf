"""A GPU as what computes the runs of a study (`bladerub.study.solver`)."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from bladerub.blade.model import ReducedBlade
from bladerub.contact.spec import RunSpec
from bladerub.extras.gpu import ADDRESS
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
        progress: Any = None,
        longer: Any = None,
    ) -> Iterator[Solved]:
        """Yield each run as it is done; raises `bladerub.extras.gpu.device.NoGpuError` without a GPU."""
        from bladerub.extras.gpu import batch, server  # load the compiler: who plans runs alone does without

        results = batch.simulate_many(blade, specs, server.find(), lambda runs, line: report(line))
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
        """Start `bladerub.extras.gpu.server`, if there is none, for the jobs of this process."""
        if os.environ.get(ADDRESS):
            return
        address = Path(tempfile.mkdtemp(prefix="bladerub-gpu-")) / "socket"
        server = subprocess.Popen(
            [sys.executable, "-m", "bladerub.extras.gpu.server", str(address)],
            stdin=subprocess.PIPE,  # ends with this process, however that ends, and the server with it
            start_new_session=True,  # Ctrl-C is for Snakemake, whose jobs may end theirs
        )
        while not address.exists():
            if server.poll() is not None:
                raise SystemExit(server.returncode)  # it has said why
            time.sleep(0.05)
        os.environ[ADDRESS] = str(address)
        _servers.append(server)


_servers: list[subprocess.Popen] = []  # keeps their input open


@cache
def gpu_digest() -> str:
    """Digest the source of what computes a run on a GPU, besides `bladerub.contact.laws.solver_digest`."""
    folder = sources.PACKAGE / "extras" / "gpu"
    return sources.source_digest(path for path in folder.iterdir() if path.suffix in (".py", ".h", ".cu"))
