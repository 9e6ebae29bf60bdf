"""Checksums of files, by which a manifest notices that one has changed on the disk."""

import hashlib
from pathlib import Path


def file_checksum(path: str | Path) -> str:
    """Return the SHA-256 of the bytes of the file at `path`, as 64 hexadecimal digits."""
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
