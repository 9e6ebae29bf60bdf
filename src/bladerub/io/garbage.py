"""The garbage collector in a process that imports much, does one thing and ends."""

import atexit
import gc

_ALLOCATIONS = 100_000
"""Objects made, less those deleted, after which garbage is looked for; of Python they are 700."""


def collect_seldom() -> None:
    """Look for garbage more seldom, and not at the end of this process.

    Modules stay to the end: to go through all of them again and again takes a quarter of the time of a job
    that draws a figure.
    """
    gc.set_threshold(_ALLOCATIONS)
    atexit.register(gc.freeze)
