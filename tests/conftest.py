"""What all tests have in common, and one thread of BLAS in them and in what they start.

The matrices are small and pytest has a process for each core. Set before NumPy is imported;
`tests/workflow/test_same_bits.py` tries other numbers.
"""

import gc
import os
import re
from pathlib import Path

import pytest

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

EXTRAS = Path(__file__).parents[1] / "src" / "bladerub" / "extras"
IMPORT = re.compile(r"^from bladerub\.extras\b", re.MULTILINE)


def pytest_ignore_collect(collection_path: Path) -> bool | None:
    """Leave out the tests of extras where these are deleted: their folder, and files that import one."""
    if EXTRAS.exists():
        return None
    if collection_path.is_dir():
        return collection_path.name == "extras" or None
    return IMPORT.search(collection_path.read_text("utf-8")) is not None or None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip what needs extras where these are deleted: tests, or those of their cases whose name matches."""
    for item in [] if EXTRAS.exists() else items:
        marker = item.get_closest_marker("extras")
        if marker and re.search(marker.kwargs.get("cases", ""), item.name):
            item.add_marker(pytest.mark.skip("needs bladerub.extras"))


def pytest_collection_finish() -> None:
    """Leave what was collected to the end: Python need not search thousands of tests for garbage."""
    gc.collect()
    gc.freeze()
