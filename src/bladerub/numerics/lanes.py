"""How many doubles a vector of compiled code has: eight, or as many more as a wide blade tip has nodes.

Every vector of the time loop has a lane for each interface node, and its length is a constant of the compiled
code. So the modules of the loop are made once for each length that is asked for: the same source, imported
again while `LANES` is another. The law of the coating is compiled into the loop in the same way: the modules
are imported again while another module is in the place of ``contact.law``.
"""

import hashlib
import importlib
import sys
import threading
from functools import cache
from types import FunctionType, ModuleType

from bladerub.numerics.user_code import bounded

USUAL = 8
"""Doubles in a vector of the modules that are imported by name."""
LANES = USUAL
"""Doubles in a vector of the module that is being imported."""
LAW = ""
"""Source of the law that the module being imported is compiled with; empty for ``contact.law`` as it is."""

FEWEST_NODES, MOST_NODES = 4, 32
"""Interface nodes that a blade may have."""

_MODULES = ("numerics.vectors", "numerics.memory", "contact.law", "contact.tip", "contact.gap")
_MODULES += ("contact.friction", "contact.kernel")  # with all in it
_LAW_MODULE = "contact.law"
_importing = threading.Lock()


def lanes_for(n_nodes: int) -> int:
    """Doubles in the vectors for a tip with `n_nodes` nodes: a power of two, whose halves can be paired."""
    lanes = USUAL
    while lanes < n_nodes:
        lanes *= 2
    return lanes


@cache
def module_for(lanes: int, name: str, law: str = "") -> ModuleType:
    """Return the module `name` of the time loop, such as ``contact.kernel.loop``, for vectors of `lanes`.

    `law` is the source of a module that takes the place of ``contact.law``. Raises `ValueError` if it cannot
    be run.
    """
    if lanes == USUAL and not law:
        return importlib.import_module(f"bladerub.{name}")
    with _importing:  # threads that begin together
        return _instance(lanes, law)[f"bladerub.{name}"]


def instance_name(lanes: int, law: str) -> str:
    """Name the modules for vectors of `lanes` and a law, by the digest of its source."""
    return f"{lanes}-{hashlib.sha256(law.encode()).hexdigest()[:16]}" if law else f"{lanes}"


@cache
def _instance(lanes: int, law: str) -> dict[str, ModuleType]:
    """Import the modules of the time loop again for other lanes or law; those in use stay as they are."""
    global LANES, LAW
    importlib.import_module("bladerub.contact.kernel.row")
    usual = _loaded()
    try:
        LANES, LAW = lanes, law
        for name in usual:
            parent, _, child = name.rpartition(".")
            del sys.modules[name]
            delattr(sys.modules.get(parent, usual.get(parent)), child)  # else found there
        if law:
            _exchange_law(law)
        importlib.import_module("bladerub.contact.kernel.row")
        modules = _loaded()
    finally:
        LANES, LAW = USUAL, ""
        sys.modules.update(usual)
        for name, module in usual.items():
            parent, _, child = name.rpartition(".")
            setattr(sys.modules[parent], child, module)
    _name(modules, instance_name(lanes, law))
    return modules


def _exchange_law(source: str) -> None:
    """Put a module of this source, which may import from ``contact.law``, in the place of that."""
    name = f"bladerub.{_LAW_MODULE}"
    importlib.import_module(name)
    module = ModuleType(name)
    with bounded("law of the coating: its module"):
        exec(compile(source, "<law of the coating>", "exec"), module.__dict__)
    sys.modules[name] = module
    parent, _, child = name.rpartition(".")
    setattr(sys.modules[parent], child, module)


def _name(modules: dict[str, ModuleType], instance: str) -> None:
    """Tell functions and classes of an instance from those of others by name.

    Machine code that comes from the disk is linked by the names of functions, and two instances that were
    compiled in different processes would have the same. It is found there by its types, some of which are
    classes of an instance: they are read as what is in the module of their name.
    """
    for name, module in modules.items():
        own_name = f"{name} {instance}".replace(".", "_")  # a dot would ask for a package
        sys.modules[own_name] = module
        for value in vars(module).values():
            function = getattr(value, "py_func", value)
            if getattr(function, "__module__", None) != name:
                continue
            if isinstance(function, FunctionType):
                function.__qualname__ = f"{function.__name__}_{instance.replace('-', '_')}"
            elif isinstance(value, type):
                value.__module__ = own_name


def _loaded() -> dict[str, ModuleType]:
    names = tuple(f"bladerub.{name}" for name in _MODULES)
    inside = tuple(f"{name}." for name in names)
    return {name: module for name, module in sys.modules.items() if name in names or name.startswith(inside)}
