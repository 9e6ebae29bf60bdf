"""One GPU of NVIDIA, by CuPy, which compiles the loop when it is first used (NVRTC) and keeps it on disk."""

import math
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from bladerub.contact.gpu.batch import WARP, Left, Work, described
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    import cupy

WARPS = 8
"""Warps that a multiprocessor holds at once: more would leave each too few registers."""
OPTIONS = ("--std=c++17", f"-DWARPS_PER_PROCESSOR={WARPS}")
SHARE = 0.8
"""Of the memory of the GPU, for what is under way."""


class NoGpuError(BadInput):
    """There is no GPU to run on, or no CuPy; the message says what would be right."""


def connect() -> Any:
    """Import CuPy and find the GPU; raises `NoGpuError`."""
    try:
        import cupy
    except ImportError as error:
        right = "pip install 'bladerub[gpu]', or take solver.device = cpu"
        raise NoGpuError(f"solver.device = gpu: needs CuPy ({error}): {right}") from error
    try:
        cupy.cuda.runtime.getDeviceCount()
    except cupy.cuda.runtime.CUDARuntimeError as error:
        right = "take solver.device = cpu"
        raise NoGpuError(f"solver.device = gpu: no GPU of NVIDIA was found ({error}): {right}") from error
    return cupy


def run(work: Work) -> Left:
    """Carry out the loop for the runs of `work`. Threads may do so at the same time.

    Raises `NoGpuError`.
    """
    cupy = connect()
    outputs = described(work)
    with _memory.held(_size(work)), cupy.cuda.Stream(non_blocking=True) as stream:
        kernel = _kernel(work.source, work.shared)
        order, *records, modes = (cupy.asarray(each) for each in work[4:])  # in the order of the arguments
        made = [cupy.full(shape, value, kind) for shape, kind, value in outputs.values()]
        n_runs, next_run = len(work.runs), cupy.zeros(1, dtype=np.int32)
        numbers = (np.int32(work.n_elements), np.int32(work.revolutions))
        kernel(
            (min(n_runs, WARPS * cupy.cuda.Device().attributes["MultiProcessorCount"]),),
            (WARP,),
            (np.int32(n_runs), order, next_run, *numbers, *records, modes, *made),
            shared_mem=8 * work.shared,
        )
        return Left(*(cupy.asnumpy(each, stream=stream) for each in (modes, *made)))


def describe() -> str:
    """Name the GPU; raises `NoGpuError`."""
    properties = connect().cuda.runtime.getDeviceProperties(0)
    return f"{properties['name'].decode()}, {properties['multiProcessorCount']} multiprocessors"


class _Memory:
    """The memory of the GPU, for what fits in at once; the rest waits."""

    def __init__(self) -> None:
        self._free: float | None = None
        self._changed = threading.Condition()

    @contextmanager
    def held(self, size: int) -> Iterator[None]:
        """Hold `size` bytes, or all if there are fewer."""
        with self._changed:
            if self._free is None:
                self._free = self._all = SHARE * connect().cuda.Device().mem_info[1]
            size = min(size, self._all)
            self._changed.wait_for(lambda: self._free >= size)
            self._free -= size
        try:
            yield
        finally:
            with self._changed:
                self._free += size
                self._changed.notify_all()


_memory = _Memory()
_compiling = threading.Lock()


def _size(work: Work) -> int:
    """Bytes on the GPU."""
    left = sum(math.prod(shape) * np.dtype(kind).itemsize for shape, kind, _ in described(work).values())
    return left + sum(each.nbytes for each in work[4:])


def _kernel(source: str, shared: int) -> "cupy.RawKernel":
    with _compiling:
        return _compiled(source, shared)


@cache
def _compiled(source: str, shared: int) -> "cupy.RawKernel":
    import cupy

    kernel = cupy.RawModule(code=source, options=OPTIONS).get_function("simulate_batch")
    kernel.max_dynamic_shared_size_bytes = 8 * shared
    return kernel
