"""What all tests have in common.

One thread of BLAS in the tests, and in what they start: the matrices are small and pytest has a process for
each core, so that more threads would wait for each other. Set before NumPy is imported;
`tests/workflow/test_same_bits.py` tries other numbers.
"""

import gc
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def pytest_collection_finish() -> None:
    """Leave what was collected to the end: Python need not search thousands of tests for garbage."""
    gc.collect()
    gc.freeze()
