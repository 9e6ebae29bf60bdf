"""What of the plan is on disk: runs done, missing, stale and corrupt, by coating."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from bladerub import datafile
from bladerub.study.confirmation import confirmation_path
from bladerub.study.grid import CoatingCase, keeps_history, run_spec, speed_name, speeds
from bladerub.study.key import run_key
from bladerub.study.store import read_manifest, read_run


@dataclass(frozen=True)
class Inventory:
    """Count of the runs of one coating, or of all.

    Parameters
    ----------
    planned : int
        Runs of the study: ``done + missing + stale + corrupt``.
    done : int
        Whole, and what the config asks for.
    missing : int
        Without a file.
    stale : int
        Whole, but of another blade, solver or setting.
    corrupt : int
        Cannot be read to the end.
    unbounded : int
        Of those done, the ones that left all bounds.
    longer_planned, longer_done : int
        Longer runs that the manifest asks for to see whether growth lasts, and those of them that are done.
    bytes : int
        Disk that the folders of the runs take, with what is on the shelf and no longer planned.
    """

    planned: int = 0
    done: int = 0
    missing: int = 0
    stale: int = 0
    corrupt: int = 0
    unbounded: int = 0
    longer_planned: int = 0
    longer_done: int = 0
    bytes: int = 0


def total(inventories: Iterable[Inventory]) -> Inventory:
    """Add up counts."""
    parts = list(inventories)
    return Inventory(*(sum(getattr(part, field.name) for part in parts) for field in fields(Inventory)))


def take(
    config: Mapping[str, Any],
    case: CoatingCase,
    folder: str | Path,
    blade_digest: str | None,
    thorough: bool = False,
    seen: Callable[[], object] = lambda: None,
) -> Inventory:
    """Compare the runs of one coating on disk with the plan.

    Parameters
    ----------
    config : mapping
        The study.
    case : CoatingCase
        The coating.
    folder : path-like
        Folder of its runs.
    blade_digest : str or None
        From `bladerub.study.key.blade_digest`; without a blade every run that is there is stale.
    thorough : bool, optional
        Read every number and compare its checksum, instead of only opening the file, which tells a
        truncated one.
    seen : callable, optional
        Called after each planned run.
    """
    folder, analysis = Path(folder), config["analysis"]
    count = dict.fromkeys(("done", "missing", "stale", "corrupt", "unbounded"), 0)
    current = set()
    planned = speeds(config)
    for f_omega in planned:
        path = folder / f"{speed_name(f_omega)}.h5"
        key = blade_digest and run_key(
            run_spec(config, case, f_omega), blade_digest, keeps_history(config, case, f_omega), analysis
        )
        state, status = _state(path, key, thorough)
        count[state] += 1
        if state == "done":
            current.add(key)
            count["unbounded"] += status == "unbounded"
        seen()
    longer = _longer_runs(folder, current)
    return Inventory(
        planned=len(planned),
        **count,
        longer_planned=len(longer),
        longer_done=sum(_state(path, key, thorough)[0] == "done" for path, key in longer.items()),
        bytes=sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()),
    )


def _state(path: Path, key: str | None, thorough: bool) -> tuple[str, str | None]:
    if not path.exists():
        return "missing", None
    try:
        about = read_run(path).attributes if thorough else datafile.read_attributes(path)
    except OSError:
        return "corrupt", None
    if "run_key" not in about:
        return "corrupt", None
    return ("done" if about["run_key"] == key else "stale"), about.get("status")


def _longer_runs(folder: Path, current: set[str]) -> dict[Path, str]:
    try:
        rows = read_manifest(folder / "manifest.tsv")
    except OSError:  # not yet there, or to be made anew: the job of the coating decides then
        return {}
    return {
        confirmation_path(folder / row.file): row.confirmation_key
        for row in rows
        if row.confirmation_key and row.run_key in current
    }
