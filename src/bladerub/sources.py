"""Digests of the package's own sources: results and machine code are valid for the code that made them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import bladerub

_PACKAGE = Path(bladerub.__file__).parent


@cache
def solver_digest() -> str:
    """Digest the source of what computes a run: the package ``contact`` and the reduced blade's own class."""
    return _source_digest([*(_PACKAGE / "contact").rglob("*.py"), _PACKAGE / "blade" / "model.py"])


@cache
def storage_digest() -> str:
    """Digest the source of what turns a result into its file."""
    return _source_digest([_PACKAGE / "study" / name for name in ("store.py", "spectra.py")])


@cache
def growth_digest() -> str:
    """Digest the source of what decides whether a run grows."""
    return _source_digest([_PACKAGE / "study" / "growth.py"])


@cache
def chart_digest() -> str:
    """Digest the source of what chooses the speeds of a cell of the chart and what it keeps of each run."""
    measuring = [f"{name}.py" for name in ("spectra", "peaks", "growth", "wear")]
    searching = [f"chart/{name}.py" for name in ("grid", "placement", "search", "cell")]
    return _source_digest([_PACKAGE / "study" / name for name in measuring + searching])


def _source_digest(paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in sorted(paths):
        # universal newlines: a checkout with other line ends is the same source
        entry = [path.relative_to(_PACKAGE).as_posix(), path.read_text(encoding="utf-8")]
        digest.update(json.dumps(entry).encode())
    return digest.hexdigest()
