"""A shelf for the runs of another study in the same place, so that a change of mind loses nothing.

Two studies that differ in the blade or the solver settings write runs of the same name. The folder
``.shelf`` beside the runs keeps what would be overwritten, each under its run key.
"""

from __future__ import annotations

import os
from pathlib import Path

from bladerub.study.store import is_current, read_run

SHELF = ".shelf"
"""Folder beside the runs; it may be deleted at any time."""


def shelve(path: str | Path) -> None:
    """Put the run at `path` on the shelf, if there is a whole one."""
    path = Path(path)
    try:
        key = read_run(path).attributes["run_key"]
    except Exception:  # whatever is wrong with the file, it is no run to keep (as in `is_current`)
        return
    shelved = _place(path, key)
    shelved.parent.mkdir(exist_ok=True)
    os.replace(path, shelved)


def unshelve(path: str | Path, key: str) -> bool:
    """Take the run that `key` stands for back to `path`, and tell whether it was on the shelf."""
    path = Path(path)
    shelved = _place(path, key)
    if not is_current(shelved, key):
        return False
    shelve(path)
    os.replace(shelved, path)
    return True


def _place(path: Path, key: str) -> Path:
    return path.parent / SHELF / f"{key}.h5"
