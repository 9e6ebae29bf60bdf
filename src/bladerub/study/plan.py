"""The runs that a study asks for: what each one is, in which file and under which key."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from bladerub.contact.spec import RunSpec
from bladerub.study.confirmation import confirmation_path, confirmation_spec
from bladerub.study.grid import CoatingCase, keeps_history, run_spec, speed_name, speeds
from bladerub.study.key import run_key
from bladerub.study.store import StoredRun


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


def claimed_run(config: Mapping[str, Any], path: str | Path, run: StoredRun, blade_digest: str) -> PlannedRun:
    """Plan again what the file of a run says it is; its own key tells whether `config` and blade made it.

    Parameters
    ----------
    config : mapping
        The study.
    path : path-like
        The file, which may lie anywhere.
    run : StoredRun
        What is in it.
    blade_digest : str
        From `bladerub.study.key.blade_digest`.

    Raises
    ------
    KeyError
        If the file lacks an attribute of a run, or the config its casing.
    """
    about = run.attributes
    case = CoatingCase.described(about)
    spec = replace(run_spec(config, case, about["f_omega"]), revolutions=about["revolutions"])
    history = "radial_displacement" in run.data
    analysis = config["analysis"]
    shortest = min(analysis["spectrum_revolutions"], spec.revolutions)  # as of a short run asked for alone
    key = run_key(spec, blade_digest, history, {**analysis, "spectrum_revolutions": shortest})
    return PlannedRun(Path(path), spec, key, history)


def longer_run(config: Mapping[str, Any], run: PlannedRun, blade_digest: str) -> PlannedRun:
    """Plan the longer run that shows whether the growth of `run` lasts (see `planned_runs`)."""
    analysis = config["analysis"]
    spec = confirmation_spec(run.spec, analysis["divergence"])
    key = run_key(spec, blade_digest, False, analysis)
    return PlannedRun(confirmation_path(run.path), spec, key, False)
