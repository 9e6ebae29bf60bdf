"""One GPU of NVIDIA, by CuPy, which compiles the loop when it is first used (NVRTC) and keeps it on disk."""

import math
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from bladerub.extras.gpu.batch import WARP, Output, Work, described, described_to_loop, longest_first
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    import cupy

WARPS = 8  # warps that a multiprocessor holds at once: more would leave each too few registers
OPTIONS = ("--std=c++17", f"-DWARPS_PER_PROCESSOR={WARPS}")
SHARE = 0.6  # of the memory of the GPU, for what is computed together


class NoGpuError(BadInput):
    """There is no GPU to run on, or no CuPy; the message says what would be right."""


def connect() -> Any:
    """Import CuPy and find the GPU; raises `NoGpuError`."""
    try:
        import cupy
    except ImportError as error:
        remedy = "pip install 'bladerub[gpu]', or take solver.device = cpu"
        raise NoGpuError(f"solver.device = gpu: needs CuPy ({error}): {remedy}") from error
    try:
        cupy.cuda.runtime.getDeviceCount()
    except cupy.cuda.runtime.CUDARuntimeError as error:
        remedy = "take solver.device = cpu"
        raise NoGpuError(f"solver.device = gpu: no GPU of NVIDIA was found ({error}): {remedy}") from error
    return cupy


def run(works: Iterable[Work], watch: Callable[[float], None] = lambda seconds: None) -> Iterator[Output]:
    """Carry out the loop for as many pieces as fit; `watch` is told their seconds, without transfers."""
    limit = SHARE * connect().cuda.Device().mem_info[1]
    together: list[Work] = []
    taken = 0
    for work in works:
        size = _size(work)
        if together and taken + size > limit:
            yield from _carry_out(together, watch)
            together, taken = [], 0
        together.append(work)
        taken += size
    if together:
        yield from _carry_out(together, watch)


def describe() -> str:
    """Name the GPU; raises `NoGpuError`."""
    properties = connect().cuda.runtime.getDeviceProperties(0)
    return f"{properties['name'].decode()}, {properties['multiProcessorCount']} multiprocessors"


_Arrays = tuple["list[cupy.ndarray]", "list[cupy.ndarray]"]  # inputs and outputs of a piece of work


def _carry_out(together: Sequence[Work], watch: Callable[[float], None]) -> Iterator[Output]:
    """Let all runs of one program share one kernel: kernels may take turns on a GPU."""
    import cupy

    by_program: dict[tuple[str, int], list[int]] = defaultdict(list)
    for number, work in enumerate(together):
        by_program[work.source, work.shared].append(number)
    arrays: dict[int, _Arrays] = {}
    launches = [
        _prepare({number: together[number] for number in numbers}, arrays) for numbers in by_program.values()
    ]
    streams = [cupy.cuda.Stream(non_blocking=True) for _ in launches]
    cupy.cuda.get_current_stream().synchronize()  # all arrays have arrived
    start = time.perf_counter()
    for launch, stream in zip(launches, streams, strict=True):
        with stream:
            launch()
    for stream in streams:
        stream.synchronize()
    watch(time.perf_counter() - start)
    for number in range(len(together)):
        inputs, outputs = arrays.pop(number)
        yield Output(*map(cupy.asnumpy, (inputs[-1], *outputs)))


def _prepare(works: Mapping[int, Work], arrays: dict[int, _Arrays]) -> Callable[[], None]:
    """Bring pieces of work of one program to the GPU and into `arrays` by number; return their launch."""
    import cupy

    batches = []
    for number, work in works.items():
        inputs = [cupy.asarray(array) for array in work[4:]]  # in the order of ``Batch``
        outputs = [_filled(*description) for description in described(work).values()]
        batches.append(described_to_loop(work, (array.data.ptr for array in (*inputs, *outputs))))
        arrays[number] = inputs, outputs
    order, work = longest_first([*works.values()]), next(iter(works.values()))
    numbers = cupy.asarray(order), _filled((1,), np.int32, 0), cupy.asarray(np.array(batches))
    kernel = _compiled(work.source, work.shared)
    warps = min(len(order), WARPS * cupy.cuda.Device().attributes["MultiProcessorCount"])
    return partial(kernel, (warps,), (WARP,), (np.int32(len(order)), *numbers), shared_mem=8 * work.shared)


def _filled(shape: tuple[int, ...], kind: type, value: float) -> "cupy.ndarray":
    """Make an array of zeros or of NaN, whose bits are all 1: without a kernel, which CuPy would compile."""
    import cupy

    array = cupy.empty(shape, dtype=kind)
    array.data.memset_async(0 if value == 0 else 0xFF, array.nbytes)
    return array


def _size(work: Work) -> int:
    """Bytes on the GPU."""
    outputs = described(work).values()
    size = sum(math.prod(shape) * np.dtype(kind).itemsize for shape, kind, _ in outputs)
    return size + sum(array.nbytes for array in work[4:])


@cache
def _compiled(source: str, shared: int) -> "cupy.RawKernel":
    import cupy

    kernel = cupy.RawModule(code=source, options=OPTIONS).get_function("simulate_batches")
    kernel.max_dynamic_shared_size_bytes = 8 * shared
    return kernel
