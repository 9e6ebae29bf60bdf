"""The key of a run: a digest of everything that determines its file, so that nothing is computed twice."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from bladerub.contact.spec import RunSpec
from bladerub.io import hdf5
from bladerub.io.provenance import PREFIX
from bladerub.io.sources import solver_digest, storage_digest

SHAPING_SETTINGS = ("spectrum_revolutions", "max_order")
"""Keys of ``config["analysis"]`` that decide what a run file holds; the others act on maps and tables."""


def run_key(spec: RunSpec, blade_digest: str, keep_history: bool, analysis: Mapping[str, Any]) -> str:
    """Digest what determines the file of one run.

    That is the run itself, the blade, the solver, what of the result is stored, and how. Other coatings
    or speeds of the study have no part in it.

    Parameters
    ----------
    spec : RunSpec
        The run.
    blade_digest : str
        From `blade_digest`.
    keep_history : bool
        Whether the whole displacement is stored.
    analysis : mapping
        ``config["analysis"]``, of which only `SHAPING_SETTINGS` count.

    Returns
    -------
    str
        SHA-256 in hexadecimal.
    """
    determinants = {
        "spec": asdict(spec),
        "blade": blade_digest,
        "solver": solver_digest(),
        "storage": storage_digest(),
        "keep_history": bool(keep_history),
        "analysis": {name: float(analysis[name]) for name in SHAPING_SETTINGS},
    }
    return hashlib.sha256(json.dumps(determinants, sort_keys=True).encode()).hexdigest()


def blade_digest(path: str | Path) -> str:
    """Digest the datasets and attributes of the reduced blade at `path`, not the bytes of the file.

    A rebuild with the same outcome keeps the digest, wherever it comes from and whatever layout the file has.

    Raises
    ------
    OSError
        If the file is missing or unreadable.
    """
    data, attributes = hdf5.read(path)
    digest = hashlib.sha256()
    for name in sorted(data):
        values = data[name]
        digest.update(json.dumps([name, values.dtype.str, values.shape]).encode())
        digest.update(values.tobytes())
    about = {name: repr(value) for name, value in attributes.items() if not name.startswith(PREFIX)}
    digest.update(json.dumps(about, sort_keys=True).encode())
    return digest.hexdigest()
