"""The machine that the benchmark runs on, in words."""

import os
import platform
from pathlib import Path
from typing import Any

from llvmlite import binding

_WIDEST = {"avx512f": 512, "avx": 256, "sse2": 128, "neon": 128}
"""Bits of the vectors that a processor has by what LLVM says of it, widest first."""


def describe() -> dict[str, Any]:
    """Describe the machine: its ``processor``, the ``vector_bits`` of that, and its ``cores``.

    The cores are those that this process may use. Bits are 64, those of one number, if LLVM knows no vectors.
    """
    features = binding.get_host_cpu_features()
    bits = (width for name, width in _WIDEST.items() if features.get(name))
    return {"processor": _processor(), "vector_bits": next(bits, 64), "cores": cores()}


def cores() -> int:
    """Count the cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):  # not on macOS
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _processor() -> str:
    """Return the name of the processor; where the system does not tell, that of LLVM."""
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text(encoding="utf-8").splitlines() if cpuinfo.exists() else []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or binding.get_host_cpu_name()
