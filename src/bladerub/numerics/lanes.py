"""How many doubles a vector of compiled code has: eight, or as many more as a wide blade tip has nodes.

Every vector of the time loop has a lane for each interface node, and its length is a constant of the compiled
code. So the modules of the loop are made once for each length that is asked for: the same source, imported
again while `LANES` is another.
"""

import importlib
import sys
import threading
from functools import cache
from types import ModuleType

USUAL = 8
"""Doubles in a vector of the modules that are imported by name."""
LANES = USUAL
"""Doubles in a vector of the module that is being imported."""

FEWEST_NODES, MOST_NODES = 4, 32
"""Interface nodes that a blade may have."""

_MODULES = ("numerics.vectors", "numerics.memory", "contact.law", "contact.tip", "contact.gap")
_MODULES += ("contact.friction", "contact.kernel")  # with all in it
_importing = threading.Lock()


def lanes_for(n_nodes: int) -> int:
    """Doubles in the vectors for a tip with `n_nodes` nodes: a power of two, whose halves can be paired."""
    lanes = USUAL
    while lanes < n_nodes:
        lanes *= 2
    return lanes


@cache
def module_for(lanes: int, name: str) -> ModuleType:
    """Return the module `name` of the time loop, such as ``contact.kernel.loop``, for vectors of `lanes`."""
    if lanes == USUAL:
        return importlib.import_module(f"bladerub.{name}")
    with _importing:  # threads that begin together
        return _instance(lanes)[f"bladerub.{name}"]


@cache
def _instance(lanes: int) -> dict[str, ModuleType]:
    """Import the modules of the time loop again for other lanes; those in use stay as they are."""
    global LANES
    importlib.import_module("bladerub.contact.kernel.row")
    usual = _loaded()
    try:
        LANES = lanes
        for name in usual:
            parent, _, child = name.rpartition(".")
            del sys.modules[name]
            delattr(sys.modules.get(parent, usual.get(parent)), child)  # else found there
        importlib.import_module("bladerub.contact.kernel.row")
        return _loaded()
    finally:
        LANES = USUAL
        sys.modules.update(usual)
        for name, module in usual.items():
            parent, _, child = name.rpartition(".")
            setattr(sys.modules[parent], child, module)


def _loaded() -> dict[str, ModuleType]:
    own = tuple(f"bladerub.{name}" for name in _MODULES)
    inside = tuple(f"{name}." for name in own)
    return {name: module for name, module in sys.modules.items() if name in own or name.startswith(inside)}
