"""The time loop for vectors of another length, another law of the elements or a further motion of the tip.

They are constants of the compiled code. A variant is a second set of the modules that have them: the same
sources, imported again while `bladerub.numerics.lanes.LANES` is another or the law is in the place of
`bladerub.contact.law`; the functions of a motion take the place of others. The set that is imported by name
stays as it is (`bladerub.contact.laws`).
"""

import hashlib
import importlib
import math
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from functools import cache
from types import FunctionType, ModuleType
from typing import NamedTuple

import numpy as np

from bladerub.contact.spec import Coating
from bladerub.extras.user_code import bounded
from bladerub.io.sources import digest_behind
from bladerub.numerics import lanes as length

_LAW = "bladerub.contact.law"
_ALIKE = ("numerics.vectors", "numerics.memory", "contact.law", "contact.tip", "contact.gap")
_ALIKE = tuple(f"bladerub.{name}" for name in (*_ALIKE, "contact.friction", "contact.kernel"))
"""Modules of which each variant has its own, and all that are in the last one."""
_importing = threading.Lock()


@cache
def module_for(lanes: int, name: str, law: str, motion: str) -> ModuleType:
    """Return the module `name` of the time loop, such as ``contact.kernel.loop``, for vectors of `lanes`.

    `law` is the source of a module that takes the place of `bladerub.contact.law`, `motion` a module whose
    ``COUNTERPARTS`` take the place of functions of the loop; each may be empty. Raises `ValueError` if the
    law cannot be run.
    """
    with _importing:  # threads that begin together
        return _Variant(lanes, law, motion).module(f"bladerub.{name}")


@cache
class _Variant:
    """The modules for vectors of `lanes`, a law and a motion, each imported when it is first asked for."""

    def __init__(self, lanes: int, law: str, motion: str):
        self.lanes, self.law, self.motion = lanes, law, motion and f"bladerub.{motion}"
        parts = [law and hashlib.sha256(law.encode()).hexdigest(), motion and digest_behind(motion)]
        self.name = "-".join([f"{lanes}", *(part[:16] for part in parts if part)])
        self._modules: dict[str, ModuleType] = {}

    def module(self, name: str) -> ModuleType:
        """Return a module by its whole name."""
        if name in self._modules:
            return self._modules[name]
        for needed in filter(None, (name, self.motion)):
            importlib.import_module(needed)  # with all that it needs: what is imported below is the variant's
        usual = self._loaded(name)
        for module in usual:
            parent, _, child = module.rpartition(".")
            del sys.modules[module]
            delattr(sys.modules.get(parent, usual.get(parent)), child)  # else found there
        try:
            _put(self._modules)
            with self._named():
                if self.law and not self._modules:
                    _exchange_law(self.law)
                importlib.import_module(name)
                if self.motion:
                    counterparts = importlib.import_module(self.motion).COUNTERPARTS
                    _exchange_functions(self._loaded(name), counterparts)
            modules = self._loaded(name)
        finally:
            for module in self._loaded(name):
                del sys.modules[module]
            _put(usual)
        new = {name: module for name, module in modules.items() if name not in self._modules}
        _name(new, self.name)
        self._modules |= new
        return self._modules[name]

    def _loaded(self, name: str) -> dict[str, ModuleType]:
        """Return what is imported of the modules that variants have, and of `name`."""
        inside = tuple(f"{module}." for module in _ALIKE)
        names = (*_ALIKE, name, self.motion)
        modules = sys.modules.items()
        return {loaded: module for loaded, module in modules if loaded in names or loaded.startswith(inside)}

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Let modules that are imported in this context have these vectors, and machine code by this name."""
        usual = length.LANES, length.COORDINATES, length.INSTANCE
        length.LANES, length.COORDINATES, length.INSTANCE = self.lanes, 3 if self.motion else 2, self.name
        try:
            yield
        finally:
            length.LANES, length.COORDINATES, length.INSTANCE = usual


def _put(modules: dict[str, ModuleType]) -> None:
    """Let an import find these modules."""
    sys.modules.update(modules)
    for name, module in modules.items():
        parent, _, child = name.rpartition(".")
        setattr(sys.modules[parent], child, module)


def _exchange_functions(modules: dict[str, ModuleType], counterparts: dict[Callable, Callable]) -> None:
    """Put counterparts in the place of functions wherever modules have these, before they are compiled."""
    for module in modules.values():
        for name, value in list(vars(module).items()):
            if isinstance(value, FunctionType) and value in counterparts:
                setattr(module, name, counterparts[value])


def _exchange_law(source: str) -> None:
    """Put a module of this source, which may import from `bladerub.contact.law`, in the place of that."""
    importlib.import_module(_LAW)
    module = ModuleType(_LAW)
    with bounded("law of the coating: its module"):
        exec(compile(source, "<law of the coating>", "exec"), module.__dict__)
    module.element = _checked(module.element, module.Element)
    _put({_LAW: module})


def _checked(element: Callable, kind: type[NamedTuple]) -> Callable:
    """Let `element` of a law raise `ValueError` on all but finite numbers, one or as many as areas."""
    fields = kind._fields

    def checked(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> NamedTuple:
        law = coating.element_law
        with bounded(f"law {law.name}: element") if law.source else nullcontext():
            parameters = tuple(element(coating, area, time_step))
        if "elastic" not in fields:
            raise ValueError(f"law {law.name}: Element has no elastic, the stiffness of an element")
        if (n := len(parameters)) != len(fields):
            raise ValueError(f"law {law.name}: element returns {n} parameters, must be {len(fields)}")
        rows = []
        for field, value in zip(fields, parameters, strict=True):
            try:
                number = np.squeeze(value) if np.isrealobj(value) else np.nan
                row = np.array(np.broadcast_to(number, np.size(area)), dtype=float)
                rows.append(row.reshape(np.shape(area)))
                wrong = "" if np.isfinite(rows[-1]).all() else "no finite number"
            except (TypeError, ValueError):
                wrong = f"an array of shape {np.shape(value)}"
            if wrong:
                requirement = f"must be a finite number, or one for each of {np.size(area)} areas"
                raise ValueError(f"law {law.name}: element gives {wrong} as {field}; {requirement}")
        return kind(*rows)

    return checked


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
