"""Keeps compiled machine code on disk for exactly the sources it was compiled from.

Numba notices a change of the file that holds a cached function, but not of functions that it calls in
other files: a run after an edit could use old code. The folder of the cache therefore carries a digest
of all sources that are compiled together, the number of lanes, and digests of what else is not the usual.
"""

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numba
from numba.core.caching import FunctionCache
from numba.extending import register_jitable

from bladerub.io.errors import BadInput
from bladerub.io.folders import cache_folder
from bladerub.numerics import lanes

if numba.config.DISABLE_JIT:
    raise BadInput("NUMBA_DISABLE_JIT is set: the time loop is compiled code alone; unset NUMBA_DISABLE_JIT")

_WITHIN = {"no_cfunc_wrapper": True}  # an entry for C; `numba.extending` makes none for Python
INLINED = _WITHIN | {"forceinline": True}
"""Options of an overload that compiled code inlines; an entry that nobody calls would be compiled, too."""
within = register_jitable(**_WITHIN)
"""Decorate a function that compiled code calls; for Python it stays as it is."""
inlined = register_jitable(**INLINED)
"""Decorate a function that compiled code inlines; for Python it stays as it is."""

_BESIDE = Path(__file__).parent / "__pycache__"


class _Cache(FunctionCache):
    """Machine code on disk, made anew where it cannot be read: cut short, or written with other modules."""

    def load_overload(self, sig, target_context):
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # whatever a damaged pickle raises
            with suppress(OSError):
                self.flush()
            return None


def njit_on_disk(sources: str, **options) -> Callable[[Callable], Callable]:
    """As `numba.njit` with ``cache=True``, in a folder that belongs to the `sources` of this digest.

    The folder is ``NUMBA_CACHE_DIR``, or beside the sources, or with what is kept for this user
    (`bladerub.io.folders.cache_folder`) where these cannot be written.
    """

    def decorate(function: Callable) -> Callable:
        user_folder = numba.config.CACHE_DIR
        parent = Path(user_folder or (_BESIDE if os.access(_BESIDE.parent, os.W_OK) else cache_folder()))
        numba.config.CACHE_DIR = str(parent / f"machine-code-{sources[:16]}-{lanes.INSTANCE}")
        try:
            compiled = numba.njit(**options)(function)
            compiled._cache = _Cache(function)  # as `cache=True` does with that of Numba
            return compiled
        finally:
            numba.config.CACHE_DIR = user_folder

    return decorate
