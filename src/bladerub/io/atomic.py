"""Files that are written whole or not at all, however the process that writes them ends."""

import os
import re
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

_HOST = re.sub(r"\W", "-", socket.gethostname())
_TEMPORARY = re.compile(r"\..+\.(?P<host>[\w-]+)\.(?P<process>\d+)\.tmp")
_ABANDONED_AFTER = 3600.0  # s, for temporary files of other hosts: the longest is written in seconds


@contextmanager
def writing(path: str | Path, mode: str = "w") -> Iterator[IO]:
    """Open a stream whose content becomes the file `path` when the block ends without an error.

    Until then it has a temporary name in the same folder, and `path` stays as it was. The content is on the
    disk before the file gets its name. (A power failure right after may lose the name: the file is then
    missing, never damaged. To flush the folder as well would double the cost.)

    The folder is made if need be. `mode` is ``"w"`` for text in UTF-8, ``"wb"`` for bytes. Raises an
    `OSError` whose ``filename`` is `path` if it cannot be written.
    """
    path = Path(path)
    temporary = path.parent / f".{path.name}.{_HOST}.{os.getpid()}.tmp"
    text = {} if "b" in mode else {"encoding": "utf-8", "newline": ""}
    try:
        with suppress(FileExistsError):  # a file, which opening reports
            path.parent.mkdir(parents=True, exist_ok=True)
        with temporary.open(mode, **text) as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, path)
    except BaseException as error:
        with suppress(OSError):
            temporary.unlink()
        places = {None, str(temporary), *map(str, path.parents)}
        if isinstance(error, OSError) and error.errno and error.filename in places:
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def delete_abandoned(folder: str | Path) -> None:
    """Delete, anywhere below `folder`, the temporary files of processes that no longer live."""
    for path in Path(folder).rglob(".*.tmp"):
        name = _TEMPORARY.fullmatch(path.name)
        if name and _is_abandoned(path, name["host"], int(name["process"])):
            path.unlink(missing_ok=True)


def _is_abandoned(path: Path, host: str, process: int) -> bool:
    try:
        if host != _HOST:
            return time.time() - path.stat().st_mtime > _ABANDONED_AFTER
        os.kill(process, 0)  # sends nothing, but looks for the process
    except ProcessLookupError:
        return True
    except (PermissionError, FileNotFoundError):  # somebody else's process; renamed meanwhile
        pass
    return False
