"""What of the plan is on disk: runs done, missing, stale and corrupt, by coating."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from bladerub.io.errors import DamagedFile
from bladerub.study.growth import needs_confirmation
from bladerub.study.manifest import ListedFile, listed_files
from bladerub.study.plan import CoatingPlan, PlannedRun, longer_run
from bladerub.study.store import ALL, StoredRun, read_run


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
        Cannot be read to the end, or not as its manifest says that it was written.
    unbounded : int
        Of those done, the ones that exceeded the displacement limit.
    unconverged : int
        Of those done, the ones in which the contact forces of some step did not converge.
    longer_planned, longer_done : int
        Longer runs that show whether the growth of those done lasts, and how many of them are done.
    bytes : int
        Disk that the folders of the runs take, with what is archived and no longer planned.
    """

    planned: int = 0
    done: int = 0
    missing: int = 0
    stale: int = 0
    corrupt: int = 0
    unbounded: int = 0
    unconverged: int = 0
    longer_planned: int = 0
    longer_done: int = 0
    bytes: int = 0


def total(inventories: Iterable[Inventory]) -> Inventory:
    """Add up counts."""
    parts = list(inventories)
    return Inventory(*(sum(getattr(part, field.name) for part in parts) for field in fields(Inventory)))


def take(
    config: Mapping[str, Any],
    plan: CoatingPlan,
    folder: str | Path,
    blade_digest: str | None,
    thorough: bool = False,
) -> tuple[Inventory, list[Path]]:
    """Compare the runs of one coating on disk with the plan.

    Parameters
    ----------
    config : mapping
        The study.
    plan : CoatingPlan
        The coating and its runs.
    folder : path-like
        Folder of the runs.
    blade_digest : str or None
        From `bladerub.study.cache.blade_digest`; without a blade every run that is there is stale.
    thorough : bool, optional
        Compare every byte with the checksum in the manifest, or read every number where there is no
        manifest yet. Otherwise read only what shows a truncated file.

    Returns
    -------
    Inventory
        The counts.
    list of Path
        The damaged files: runs, longer runs, the manifest.
    """
    folder, settings = Path(folder), config["analysis"]["divergence"]
    listed, damaged = _listed(folder / "manifest.tsv")
    if thorough:
        damaged += [file.path for file in listed.values() if file.is_damaged()]

    def look(run: PlannedRun) -> tuple[str, StoredRun | None]:
        path = folder / run.file
        if not path.exists():
            return "missing", None
        if path in damaged:
            return "corrupt", None
        try:
            stored = read_run(path, ALL if thorough and path not in listed else {"revolution_amplitude"})
        except Exception:  # whatever a damaged file makes h5py raise
            damaged.append(path)
            return "corrupt", None
        current = blade_digest is not None and stored.attributes["run_key"] == run.key(blade_digest)
        return ("done" if current else "stale"), stored

    counts: Counter[str] = Counter()
    for run in plan.runs:
        state, stored = look(run)
        counts[state] += 1
        if state != "done":
            continue
        status = stored.attributes["status"]
        counts["unbounded"] += status == "unbounded"
        counts["unconverged"] += stored.attributes["n_unconverged_steps"] > 0
        if needs_confirmation(stored.data["revolution_amplitude"], status, settings):
            counts["longer_planned"] += 1
            counts["longer_done"] += look(longer_run(config, run))[0] == "done"
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    return Inventory(planned=len(plan.runs), bytes=size, **counts), damaged


def _listed(manifest: Path) -> tuple[dict[Path, ListedFile], list[Path]]:
    """Return the files that the manifest lists by path, and the manifest itself if it is damaged."""
    try:
        return {file.path: file for file in listed_files(manifest)}, []
    except FileNotFoundError:
        return {}, []
    except DamagedFile:
        return {}, [manifest]
