"""The loop of the GPU on this processor, its 32 lanes as arrays: for tests, and to change it without a GPU.

A C++ compiler, ``c++``, compiles the source that a GPU is given. It is some ten times slower than the time
loop of `bladerub.contact.kernel`.
"""

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import numpy as np

from bladerub.extras.gpu.batch import Output, Work, described, described_to_loop, longest_first

COMPILER = "c++"
_OPTIONS = ("-O2", "-march=native", "-std=c++17", "-shared", "-fPIC", "-Wno-psabi")


def is_possible() -> bool:
    """Whether there is a compiler."""
    return shutil.which(COMPILER) is not None


def run(works: Iterable[Work], real: str = "double") -> Iterator[Output]:
    """Carry out the loop in the C++ type `real`, with doubles in arrays; `OSError` without a compiler."""
    return (_run(work, real) for work in works)


def _run(work: Work, real: str) -> Output:
    outputs = {name: np.full(shape, value, kind) for name, (shape, kind, value) in described(work).items()}
    modes, next_run = work.modes.copy(), np.zeros(1, dtype=np.int32)
    arrays = (*work[4:-1], modes, *outputs.values())  # in the order of ``Batch``
    batch = described_to_loop(work, (array.ctypes.data for array in arrays))
    call(_compiled(work.source, real), len(work.runs), longest_first([work]), next_run, batch)
    return Output(modes, **outputs)


def call(loop: "ctypes._FuncPointer", n_runs: int, *arrays: np.ndarray) -> None:
    """Call the loop with its arguments."""
    loop(n_runs, *(ctypes.c_void_p(array.ctypes.data) for array in arrays))


@cache
def _compiled(source: str, real: str) -> "ctypes._FuncPointer":
    with tempfile.TemporaryDirectory(prefix="bladerub-") as folder:
        text, library = Path(folder, "loop.cpp"), Path(folder, "loop.so")
        text.write_text(source, encoding="utf-8")
        subprocess.run([COMPILER, *_OPTIONS, f"-DREAL={real}", "-o", library, text], check=True)
        return ctypes.CDLL(str(library)).simulate_batches
