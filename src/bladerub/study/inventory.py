"""What of the plan is on disk: runs done, missing, stale and corrupt, by coating."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from bladerub.io.errors import DamagedFile
from bladerub.study.grid import CoatingCase
from bladerub.study.growth import needs_confirmation
from bladerub.study.plan import PlannedRun, longer_run, planned_runs
from bladerub.study.store import StoredRun, read_manifest, read_run


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
        Longer runs that show whether the growth of those done lasts, and how many of them are done.
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
    damaged: Callable[[Path], object] = lambda path: None,
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
        Read every number and compare its checksum, instead of only what tells a truncated file.
    seen : callable, optional
        Called after each planned run.
    damaged : callable, optional
        Called with each file that cannot be read to its end: runs, longer ones, the manifest.
    """
    folder, settings = Path(folder), config["analysis"]["divergence"]
    count = dict.fromkeys(("done", "missing", "stale", "corrupt", "unbounded", *_LONGER), 0)
    digest = blade_digest or "no blade"  # under which no run was ever made
    planned = planned_runs(config, case, folder, digest)
    if _is_damaged(folder / "manifest.tsv"):
        damaged(folder / "manifest.tsv")
    for run in planned:
        state, stored = _look(run, thorough, damaged)
        count[state] += 1
        if state == "done":
            status = stored.attributes["status"]
            count["unbounded"] += status == "unbounded"
            if needs_confirmation(stored.data["revolution_amplitude"], status, settings):
                count["longer_planned"] += 1
                longer, _ = _look(longer_run(config, run, digest), thorough, damaged)
                count["longer_done"] += longer == "done"
        seen()
    return Inventory(
        planned=len(planned),
        **count,
        bytes=sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()),
    )


_LONGER = ("longer_planned", "longer_done")


def _is_damaged(manifest: Path) -> bool:
    try:
        read_manifest(manifest)
    except DamagedFile:
        return True
    except FileNotFoundError:
        pass
    return False


def _look(run: PlannedRun, thorough: bool, damaged: Callable[[Path], object]) -> tuple[str, StoredRun | None]:
    if not run.path.exists():
        return "missing", None
    try:
        stored = read_run(run.path, frozenset() if thorough else {"revolution_amplitude"})
    except Exception:  # whatever is wrong with the file (as in `bladerub.study.store.is_current`)
        damaged(run.path)
        return "corrupt", None
    return ("done" if stored.attributes["run_key"] == run.key else "stale"), stored
