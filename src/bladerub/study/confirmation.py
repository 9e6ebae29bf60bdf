"""The longer run that shows whether growth lasts: which runs get one, how it is made and where it lies.

It is a run like any other, from rest with the same step, in a file and under a key of its own: the run of the
study and its file stay what they are, and another length of confirmation makes none of them stale.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bladerub.contact.spec import RunSpec
from bladerub.io.sources import growth_digest

FOLDER = "confirmation"
"""Folder of the longer runs, beside the runs of a coating; each has the name of the run it repeats."""


def confirmation_path(run_path: str | Path) -> Path:
    """Return where the longer run of the run at `run_path` lies."""
    run_path = Path(run_path)
    return run_path.parent / FOLDER / run_path.name


def confirmation_spec(spec: RunSpec, settings: Mapping[str, Any]) -> RunSpec:
    """Describe the longer run, of which the first ``spec.revolutions`` are the run itself.

    Parameters
    ----------
    spec : RunSpec
        The run of the study.
    settings : mapping
        ``config["analysis"]["divergence"]``.
    """
    return dataclasses.replace(spec, revolutions=int(settings["confirmation_revolutions"]))


def determinants(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return what decides which runs are repeated, beside the runs themselves; nothing where none is."""
    if settings["confirmation_revolutions"] == 0:
        return {}
    return {**settings, "definition": growth_digest()}
