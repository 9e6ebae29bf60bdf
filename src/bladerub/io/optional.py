"""Packages that only some features need, which an extra of this package installs."""

import importlib
from types import ModuleType

from bladerub.io.errors import BadInput


class MissingPackage(BadInput, ImportError):
    """A package that is needed here and is not installed; the message has the command that installs it."""


def package(module: str, extra: str) -> ModuleType:
    """Import a `module` that the `extra` of this package brings; raises `MissingPackage` without it."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module.partition(".")[0]:
            raise
        raise MissingPackage(f"needs {error.name}: pip install 'bladerub[{extra}]'") from None
