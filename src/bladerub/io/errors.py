"""What can be wrong with a file or with what is given, in words that name it and say what to do."""

from __future__ import annotations

import errno
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_FULL = {errno.ENOSPC: "the disk is full", errno.EDQUOT: "the disk quota is used up"}
_FORBIDDEN = {errno.EROFS, errno.EACCES, errno.EPERM}


class DamagedFile(OSError):
    """A file that is not, or no longer, what it should be; the message names it."""


class BadInput(ValueError):
    """Something given that cannot be used; the message says what would be right, in one line a fault."""


def message_for(error: OSError | BadInput) -> str:
    """Say what is at fault and what to do about it; in one line, if it is a file."""
    if isinstance(error, BadInput):
        return str(error)
    if isinstance(error, DamagedFile):
        return f"{error}; delete it and run the same command again: it is made anew, and nothing else is lost"
    where = "" if error.filename is None else f"{error.filename}: "
    if error.errno in _FULL:
        return (
            f"{where}{_FULL[error.errno]}; make room and run the same command again: "
            "what is finished is kept and not computed anew"
        )
    if error.errno in _FORBIDDEN:
        return (
            f"{where}{error.strerror}; make it writable, or choose another folder with the key results "
            "of the config"
        )
    return f"{where}{error.strerror or error}"


@contextmanager
def exit_on_error() -> Iterator[None]:
    """Turn an `OSError` or `BadInput` into its words on standard error and exit code 2, no traceback."""
    try:
        yield
    except (OSError, BadInput) as error:
        print(message_for(error), file=sys.stderr)
        sys.exit(2)
