"""One thread of BLAS in the tests, and in what they start.

The matrices are small and pytest has a process for each core, so that more threads would wait for each other.
Set before NumPy is imported; `tests/workflow/test_same_bits.py` tries other numbers.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
