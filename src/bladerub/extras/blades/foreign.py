"""What can be wrong with a file that a reader of another package reads."""

import errno
from pathlib import Path
from typing import NoReturn

from bladerub.io.errors import is_refused


def refuse_content(path: Path, error: Exception) -> NoReturn:
    """Raise the `error` of a foreign reader: a ValueError of what it read, an OSError of the system."""
    if is_refused(error) and error.errno != errno.EINVAL:  # that is of offsets in damaged archives
        error.filename = error.filename or str(path)
        raise error
    reason = str(error) or type(error).__name__
    raise ValueError(f"is not a {path.suffix.lower()} file that can be read ({reason})") from error
