"""Computed files under keys, so that nothing is computed twice and a change of mind loses nothing.

An entry of the cache is one HDF5 file, as of a run of the study. It holds as an attribute
its key, a digest of everything that determines it. An entry of another key in its place, as of another
blade or other solver settings, is stale. Before a stale entry is overwritten it is moved to the archive, the
folder `ARCHIVE` next to it, and it is taken back from there when its key is asked for again.
"""

import hashlib
import json
import os
import re
from collections.abc import Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bladerub.io import checksum, hdf5
from bladerub.io.errors import is_refused
from bladerub.io.provenance import PREFIX

ARCHIVE = ".archive"  # folder of the archived entries, each under its key; it may be deleted at any time


def digest(determinants: Any) -> str:
    """Digest (SHA-256) what JSON can express, or fields of dataclasses, whatever the order of keys."""
    return hashlib.sha256(json.dumps(determinants, sort_keys=True, default=vars).encode()).hexdigest()


def blade_digest(path: str | Path) -> str:
    """Digest what a reduced blade holds, so that an equal rebuild keeps it; `OSError` if it is unreadable."""
    data, attributes = hdf5.read_any(path)
    content = hashlib.sha256()
    for name in sorted(data):
        values = data[name]
        content.update(json.dumps([name, values.dtype.str, values.shape]).encode())
        content.update(values.tobytes())
    described = {name: repr(value) for name, value in attributes.items() if not name.startswith(PREFIX)}
    content.update(json.dumps(described, sort_keys=True).encode())
    return content.hexdigest()


@dataclass(frozen=True)
class Entry:
    """A file that is to hold what its key stands for, and at least these datasets."""

    path: Path
    key: str
    datasets: Set[str]
    attribute: str = "run_key"  # that holds the key

    def fetch(self) -> bool:
        """Take the file back from the archive unless it is current; return whether it is now.

        A file is current if it has the key and the datasets, and the checksum that it carries; without one,
        as of older versions, nothing tells that it is still as it was computed. Raises `OSError` if the
        system refuses to read it: what it holds may be current.
        """
        if self._is_current(self.path):
            return True
        archived = self._archived(self.key)
        if not self._is_current(archived):
            return False
        self.make_room()
        os.replace(archived, self.path)
        return True

    def make_room(self) -> None:
        """Move what is in the file now to the archive, if it is a whole entry."""
        key = self._key_in(self.path)
        if key is not None:
            archived = self._archived(key)
            archived.parent.mkdir(exist_ok=True)
            os.replace(self.path, archived)

    def _archived(self, key: str) -> Path:
        return self.path.parent / ARCHIVE / f"{key}{self.path.suffix}"

    def _is_current(self, path: Path) -> bool:
        return self._key_in(path) == self.key and checksum.is_sealed(path)

    def _key_in(self, path: Path) -> str | None:
        """Read the whole file and return its key, or None if it is missing or anything is wrong with it."""
        try:
            if not path.exists():  # asked three times of every new run, and faster than h5py
                return None
            data, attributes = hdf5.read(path)
        except Exception as error:  # h5py raises anything on a damaged file, which is to be computed again
            if is_refused(error):
                raise
            return None
        key = str(attributes.get(self.attribute, ""))
        # a key is the name of a file in the archive
        return key if self.datasets <= data.keys() and re.fullmatch(r"\w+", key) else None
