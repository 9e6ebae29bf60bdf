"""The time loop for vectors of another length, or with another law of the elements.

Both are constants of the compiled code. A variant is a second set of the modules that have them: the same
sources, imported again while `bladerub.numerics.lanes.LANES` is another or the law is in the place of
`bladerub.contact.law`. The set that is imported by name stays as it is.
"""

import importlib
import sys
import threading
from functools import cache
from types import FunctionType, ModuleType

from bladerub.numerics.lanes import USUAL, counterparts, importing_for, instance_name
from bladerub.numerics.user_code import bounded

_LAW = "bladerub.contact.law"
_ALIKE = ("numerics.vectors", "numerics.memory", "contact.law", "contact.tip", "contact.gap")
_ALIKE = tuple(
    f"bladerub.{name}" for name in (*_ALIKE, "contact.friction", *counterparts(), "contact.kernel")
)
"""Modules of which each variant has its own, and all that are in the last one."""

_importing = threading.Lock()


@cache
def module_for(lanes: int, name: str, law: str = "") -> ModuleType:
    """Return the module `name` of the time loop, such as ``contact.kernel.loop``, for vectors of `lanes`.

    `law` is the source of a module that takes the place of `bladerub.contact.law`. A module that builds on
    the loop may be asked for as well. Raises `ValueError` if the law cannot be run.
    """
    if lanes == USUAL and not law:
        return importlib.import_module(f"bladerub.{name}")
    with _importing:  # threads that begin together
        return _variant(lanes, law).module(f"bladerub.{name}")


class _Variant:
    """The modules for vectors of `lanes` and a law, each imported when it is first asked for."""

    def __init__(self, lanes: int, law: str):
        self.lanes, self.law = lanes, law
        self._modules: dict[str, ModuleType] = {}

    def module(self, name: str) -> ModuleType:
        """Return a module by its whole name."""
        if name not in self._modules:
            self._import(name)
        return self._modules[name]

    def _import(self, name: str) -> None:
        importlib.import_module(name)  # with all that it needs: what is first imported below is the variant's
        usual = _loaded(name)
        for module in usual:
            _take_away(module, usual)
        try:
            _put(self._modules)
            with importing_for(self.lanes, self.law):
                if self.law and not self._modules:
                    _exchange_law(self.law)
                importlib.import_module(name)
            modules = _loaded(name)
        finally:
            for module in _loaded(name):
                del sys.modules[module]
            _put(usual)
        new = {name: module for name, module in modules.items() if name not in self._modules}
        _name(new, instance_name(self.lanes, self.law))
        self._modules |= new


_variant = cache(_Variant)


def _loaded(name: str) -> dict[str, ModuleType]:
    """Return what is imported of the modules that variants have, and of `name`."""
    inside = tuple(f"{module}." for module in _ALIKE)
    return {
        loaded: module
        for loaded, module in sys.modules.items()
        if loaded in (*_ALIKE, name) or loaded.startswith(inside)
    }


def _take_away(name: str, usual: dict[str, ModuleType]) -> None:
    parent, _, child = name.rpartition(".")
    del sys.modules[name]
    delattr(sys.modules.get(parent, usual.get(parent)), child)  # else found there


def _put(modules: dict[str, ModuleType]) -> None:
    """Let an import find these modules."""
    sys.modules.update(modules)
    for name, module in modules.items():
        parent, _, child = name.rpartition(".")
        setattr(sys.modules[parent], child, module)


def _exchange_law(source: str) -> None:
    """Put a module of this source, which may import from `bladerub.contact.law`, in the place of that."""
    importlib.import_module(_LAW)
    module = ModuleType(_LAW)
    with bounded("law of the coating: its module"):
        exec(compile(source, "<law of the coating>", "exec"), module.__dict__)
    _put({_LAW: module})


def _name(modules: dict[str, ModuleType], instance: str) -> None:
    """Tell functions and classes of a variant from those of others by name.

    Machine code that comes from the disk is linked by the names of functions, and two variants that were
    compiled in different processes would have the same. It is found there by its types, some of which are
    classes of a variant: they are read as what is in the module of their name.
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
