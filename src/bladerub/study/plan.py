"""The runs that a study asks for: what each one is, in which file and under which key."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bladerub.contact.spec import RunSpec
from bladerub.study.confirmation import confirmation_path, confirmation_spec
from bladerub.study.grid import CoatingCase, keeps_history, run_spec, speed_name, speeds
from bladerub.study.key import run_key


@dataclass(frozen=True)
class PlannedRun:
    """One run that is to be in its file under its key.

    Parameters
    ----------
    path : Path
        The file.
    spec : RunSpec
        The run.
    key : str
        From `bladerub.study.key.run_key`.
    keep_history : bool
        Whether to store the whole radial displacement of node 1.
    """

    path: Path
    spec: RunSpec
    key: str
    keep_history: bool


def planned_runs(
    config: Mapping[str, Any], case: CoatingCase, folder: str | Path, blade_digest: str
) -> list[PlannedRun]:
    """List the runs of one coating at all speeds of the study.

    Parameters
    ----------
    config : mapping
        The study.
    case : CoatingCase
        The coating.
    folder : path-like
        Where its runs live.
    blade_digest : str
        From `bladerub.study.key.blade_digest`.
    """
    runs = []
    for f_omega in speeds(config):
        history = keeps_history(config, case, f_omega)
        spec = run_spec(config, case, f_omega)
        path = Path(folder) / f"{speed_name(f_omega)}.h5"
        runs.append(PlannedRun(path, spec, run_key(spec, blade_digest, history, config["analysis"]), history))
    return runs


def longer_run(config: Mapping[str, Any], run: PlannedRun, blade_digest: str) -> PlannedRun:
    """Plan the longer run that shows whether the growth of `run` lasts (see `planned_runs`)."""
    analysis = config["analysis"]
    spec = confirmation_spec(run.spec, analysis["divergence"])
    key = run_key(spec, blade_digest, False, analysis)
    return PlannedRun(confirmation_path(run.path), spec, key, False)
