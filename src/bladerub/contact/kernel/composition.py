"""How the time loop is composed: by the paper's functions, or others where the profile of the tip turns.

The modules of the loop have the paper's: the profile keeps its angle. Those marked `composed` have a
counterpart in `bladerub.contact.kernel.turning`. The compiler takes one of both by the type of their first
argument, the record ``Modal``, whose field ``tilt`` is None where the profile keeps its angle: nothing of a
tilt is in the machine code of the paper's loop.
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
        keeps_its_angle = isinstance(modal.types[modal.fields.index("tilt")], types.NoneType)
        return function if keeps_its_angle else _counterparts[function]

    return function


def in_place_of(function: Callable) -> Callable[[Callable], Callable]:
    """Decorate the counterpart of a `composed` function, which has the same arguments."""

    def decorate(counterpart: Callable) -> Callable:
        _counterparts[function] = counterpart
        return counterpart

    return decorate
