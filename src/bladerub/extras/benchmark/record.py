"""The machine that the benchmark runs on, and tables of several: with the loops there, and with a GPU."""

import os
import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd
from llvmlite import binding

from bladerub.io import tables

MACHINE = ["processor", "vector_bits", "cores"]  # columns that tell machines apart
LOOPS = ("numpy", "numba", "production")
_WHOLE = ["peak_flops", "seconds_per_run", "study_minutes", "cost_of_stress"]
COLUMNS = [  # of the table of the loops, a row for each machine and kind of motion
    *(*MACHINE, "motion"),
    *(f"steps_per_second_{loop}" for loop in LOOPS),
    *("ratio_to_numpy", "ratio_to_numba", "fraction_of_peak", *_WHOLE),
]
GPU_COLUMNS = [  # of the table of GPUs
    *("gpu", "processor", "cores", "gpu_runs", "handed_over", "kernel_s", "gpu_s", "gpu_steps_per_second"),
    *("compared_runs", "seconds_per_run", "same_status", "same_steps", "same_contact_steps"),
    *("peak_error_median", "peak_error_p95", "peak_error_p99", "peak_error_largest", "largest_residual"),
]
_WIDEST = {"avx512f": 512, "avx": 256, "sse2": 128, "neon": 128}  # bits of vectors by what LLVM calls them


def describe() -> dict[str, Any]:
    """Describe this one by `MACHINE`; bits are 64, those of one number, if LLVM knows no vectors."""
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


def rows(figures: Mapping[str, Any]) -> pd.DataFrame:
    """Arrange what `measure.benchmark` returns in two rows: with contact, and free."""
    machine, totals = ([figures.get(name) for name in names] for names in (MACHINE, _WHOLE))
    records = []
    for motion, ending in (("contact", ""), ("free", "_free")):
        steps = [figures["steps_per_second"][loop][motion] for loop in LOOPS]
        ratios = [figures[f"ratio_to_{loop}{ending}"] for loop in ("numpy", "numba")]
        records.append([*machine, motion, *steps, *ratios, figures[f"fraction_of_peak_{motion}"], *totals])
    return pd.DataFrame(records, columns=COLUMNS)


def gpu_row(figures: Mapping[str, Any]) -> pd.DataFrame:
    """Arrange what `gpu.compare` returns, with the name of the ``gpu``."""
    return pd.DataFrame([figures], columns=GPU_COLUMNS)


def replace(path: str | Path, new: pd.DataFrame, by: list[str], origin: Mapping[str, str]) -> None:
    """Put rows into the table at `path`, in the place of its old ones with equal values `by` columns."""
    old = recorded(path, list(new.columns))
    if len(old):
        matches = (old[by] == new.loc[0, by].to_numpy()).all(axis="columns")
        new = pd.concat([old[~matches], new])
    tables.write(path, new, origin, "%.4g", [Path(__file__).with_name("columns.csv")])


def recorded(path: str | Path, columns: list[str]) -> pd.DataFrame:
    """Read the table at `path`, without rows if there is none; raises as `bladerub.io.tables.read`."""
    return tables.read(path, columns) if Path(path).exists() else pd.DataFrame(columns=columns)
