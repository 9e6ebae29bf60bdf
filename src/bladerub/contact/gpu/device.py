"""One GPU of NVIDIA, by CuPy, which compiles the loop when it is first used (NVRTC) and keeps it on disk."""

import math
import time
from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bladerub.contact.gpu.batch import WARP, Left, Work, described
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    import cupy

WARPS = 8
"""Warps that a multiprocessor holds at once: more would leave each too few registers."""
OPTIONS = ("--std=c++17", f"-DWARPS_PER_PROCESSOR={WARPS}")
SHARE = 0.6
"""Of the memory of the GPU, for what is under way."""
TOGETHER = 32
"""Pieces of work that are under way at once: at its end one leaves most of the GPU to others."""


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


def run(works: Iterable[Work], watch: Callable[[float], None] = lambda seconds: None) -> Iterator[Left]:
    """Carry out the loop for pieces of work, some of them together; yield what each leaves.

    `watch` is told the seconds that those took which ran together, without transfers. Raises `NoGpuError`.
    """
    most = SHARE * connect().cuda.Device().mem_info[1]
    together: list[_Prepared] = []
    for work in works:
        size = _size(work)
        if together and (len(together) == TOGETHER or sum(each.size for each in together) + size > most):
            yield from _carry_out(together, watch)
            together = []
        together.append(_prepare(work, size, _streams()[len(together)]))
    yield from _carry_out(together, watch)


def describe() -> str:
    """Name the GPU; raises `NoGpuError`."""
    properties = connect().cuda.runtime.getDeviceProperties(0)
    return f"{properties['name'].decode()}, {properties['multiProcessorCount']} multiprocessors"


class _Prepared(NamedTuple):
    """A piece of work whose arrays are on the GPU."""

    stream: "cupy.cuda.Stream"
    launch: Callable[[], None]
    left: list  # Arrays
    size: int  # Bytes


def _prepare(work: Work, size: int, stream: "cupy.cuda.Stream") -> _Prepared:
    import cupy

    with stream:
        kernel = _compiled(work.source, work.shared)
        order, *records, modes = (cupy.asarray(each) for each in work[4:])  # in the order of the arguments
        made = [_filled(*each) for each in described(work).values()]
        n_runs, next_run = len(work.runs), _filled((1,), np.int32, 0)
    numbers = (np.int32(work.n_elements), np.int32(work.revolutions))
    warps = min(n_runs, WARPS * cupy.cuda.Device().attributes["MultiProcessorCount"])
    arguments = (np.int32(n_runs), order, next_run, *numbers, *records, modes, *made)
    launch = partial(kernel, (warps,), (WARP,), arguments, shared_mem=8 * work.shared)
    return _Prepared(stream, launch, [modes, *made], size)


def _filled(shape: tuple[int, ...], kind: type, value: float) -> "cupy.ndarray":
    """Make an array of zeros or of NaN, whose bits are all 1: without a kernel, which CuPy would compile."""
    import cupy

    array = cupy.empty(shape, dtype=kind)
    array.data.memset_async(0 if value == 0 else 0xFF, array.nbytes)
    return array


def _carry_out(together: Iterable[_Prepared], watch: Callable[[float], None]) -> Iterator[Left]:
    """Let pieces of work run side by side: none of them waits for memory that another gives back."""
    import cupy

    for each in together:
        each.stream.synchronize()  # its arrays have arrived
    start = time.perf_counter()
    for each in together:
        with each.stream:
            each.launch()
    for each in together:
        each.stream.synchronize()
    watch(time.perf_counter() - start)
    for each in together:
        with each.stream:
            left = Left(*(cupy.asnumpy(array) for array in each.left))
        yield left


@cache
def _streams() -> "list[cupy.cuda.Stream]":
    """Keep the streams: memory that CuPy has reserved for one is for it alone."""
    import cupy

    return [cupy.cuda.Stream(non_blocking=True) for _ in range(TOGETHER)]


def _size(work: Work) -> int:
    """Bytes on the GPU."""
    left = sum(math.prod(shape) * np.dtype(kind).itemsize for shape, kind, _ in described(work).values())
    return left + sum(each.nbytes for each in work[4:])


@cache
def _compiled(source: str, shared: int) -> "cupy.RawKernel":
    import cupy

    kernel = cupy.RawModule(code=source, options=OPTIONS).get_function("simulate_batch")
    kernel.max_dynamic_shared_size_bytes = 8 * shared
    return kernel
