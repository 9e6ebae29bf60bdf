"""Checksums of files, by which a changed bit is noticed: in a manifest, and in each file itself.

A file that carries its own checksum holds `BLANK`, with the digits of a SHA-256 in place of the zeros: that
of its bytes as they are with the zeros. It is made once, when the file is written, and goes where the file
goes: no manifest is needed to notice a changed bit, and none that is made anew can hide one.
"""

import hashlib
import re
from pathlib import Path

from bladerub.io.errors import DamagedFile

BLANK = f"file checksum, sha256={64 * '0'}"  # what is written first in a file that is to carry its checksum

_CARRIED = re.compile(rb"file checksum, sha256=([0-9a-f]{64})")
_SIGNS = (b"file checksum", b"sha256=")  # no single bit spoils both


def file_checksum(path: str | Path) -> str:
    """Return the SHA-256 of the bytes of the file at `path`, as 64 hexadecimal digits."""
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def seal(content: bytes, companion: bytes = b"") -> bytes:
    """Return the bytes of a file with the checksum of them and of its `companion` in place of `BLANK`."""
    digits = hashlib.sha256(content + companion).hexdigest()
    return content.replace(BLANK.encode(), BLANK.replace(64 * "0", digits).encode())


def is_sealed(path: str | Path, *companions: str | Path) -> bool:
    """Return whether the file at `path` carries a checksum, which is of its `companions` as well.

    Those of older versions and of other programs do not. Raises `DamagedFile` if a bit is not as it was
    written, another `OSError` if a file is missing or cannot be read.
    """
    content = Path(path).read_bytes()
    if not any(sign in content for sign in _SIGNS):
        return False
    carried = _CARRIED.search(content)
    blank = _CARRIED.sub(BLANK.encode(), content, count=1)
    if carried is None or seal(blank, b"".join(Path(file).read_bytes() for file in companions)) != content:
        raise DamagedFile(f"{path}: not as it was written, its checksum is of other content")
    return True
