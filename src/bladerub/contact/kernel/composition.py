"""How the time loop is composed: by the paper's functions, or others where the tip moves otherwise as well.

The modules of the loop have the paper's: the nodes of the tip move, the profile keeps its angle. Those marked
`composed` may have a counterpart (`bladerub.contact.motion`). The compiler takes one of both by the type of
their first argument, the record ``Modal``, whose field ``further`` is None for the paper's: nothing of
another motion is in the machine code of the paper's loop.
"""

from collections.abc import Callable

from numba import types
from numba.extending import overload

from bladerub.numerics.machine_code import INLINED

_counterparts: dict[Callable, Callable] = {}


def composed(function: Callable) -> Callable:
    """Decorate a function of the loop that has a counterpart; compiled code inlines one of both."""

    @overload(function, strict=False, jit_options=INLINED)
    def choose(modal, *_):
        is_of_paper = isinstance(modal.types[modal.fields.index("further")], types.NoneType)
        return function if is_of_paper else _counterparts[function]

    return function


def in_place_of(function: Callable) -> Callable[[Callable], Callable]:
    """Decorate the counterpart of a `composed` function, which has the same arguments."""

    def decorate(counterpart: Callable) -> Callable:
        _counterparts[function] = counterpart
        return counterpart

    return decorate
