"""What can be wrong with a file or an input, and the message that names it and says what to do."""

import copyreg
import errno
import importlib
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from bladerub.plugins import MissingPart

_FULL = {errno.ENOSPC: "the disk is full", errno.EDQUOT: "the disk quota is used up"}
_FORBIDDEN = {errno.EROFS, errno.EACCES, errno.EPERM}
_LOCKED = {errno.EAGAIN, errno.ENOLCK, errno.EDEADLK}


class DamagedFile(OSError):
    """A file that is not, or no longer, what it should be; the message names it."""


def is_refused(error: Exception) -> bool:
    """Return whether the system refused to open or read a file, of whose content nothing is known then.

    A lock, a permission, a stale handle, too many open files or a failing disk: all but that there is none.
    """
    absent = isinstance(error, FileNotFoundError | IsADirectoryError | NotADirectoryError)
    return isinstance(error, OSError) and bool(error.errno) and not absent


class BadInput(ValueError):
    """An input that cannot be used; the message says what would be right, one line for each problem."""

    def __reduce__(self) -> tuple:
        """Pickle the message as it is: a subclass may be made of other arguments."""
        return copyreg.__newobj__, (type(self), *self.args), vars(self)


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


def message_for(error: OSError | BadInput | MissingPart) -> str:
    """Say what is wrong and what to do about it; in one line, if it is a file."""
    if isinstance(error, BadInput | MissingPart):
        return str(error)
    if isinstance(error, DamagedFile):
        return f"{error}; delete it and run the same command again: it is made again, nothing else is lost"
    path, problem, remedy = error.filename or "", error.strerror or str(error), ""
    if error.errno in _FULL:
        problem = _FULL[error.errno]
        remedy = "; make room and run the same command again: what is finished is kept and not computed again"
    elif error.errno in _LOCKED:
        problem = f"locked by another program, or its disk has no locks ({problem})"
        remedy = "; close that program, or set HDF5_USE_FILE_LOCKING=FALSE"
    elif error.errno in _FORBIDDEN and path and not _is_readable(path):
        remedy = "; make it readable"
    elif error.errno in _FORBIDDEN:
        remedy = "; make it writable, or choose another folder with the key results of the config"
    return f"{path}{': ' if path else ''}{problem}{remedy}"


def _is_readable(path: str) -> bool:
    """Return whether a file or folder may be read, or is not there, in a folder that may be entered."""
    entered, entry = os.path.dirname(path) or ".", os.R_OK | os.X_OK * os.path.isdir(path)
    return os.access(entered, os.X_OK) and (not os.path.lexists(path) or os.access(path, entry))


@contextmanager
def exit_on_error() -> Iterator[None]:
    """Turn an error of input or files into its message on standard error and exit code 2, no traceback."""
    try:
        yield
    except (OSError, BadInput, MissingPart) as error:
        print(message_for(error), file=sys.stderr)
        sys.exit(2)


def format_value(value: Any) -> str:
    """Write a value of the config on one short line of printable characters."""
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    text = " ".join("".join(char if char.isprintable() else " " for char in text).split())
    return text if len(text) <= 60 else text[:57] + "..."
