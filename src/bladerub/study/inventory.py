"""What of the plan is on disk: runs done, missing, stale and corrupt, by coating."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from bladerub.study.growth import needs_confirmation
from bladerub.study.manifest import damaged_files
from bladerub.study.plan import CoatingPlan, PlannedRun, longer_run
from bladerub.study.store import ALL, StoredRun, read_run

COUNTS = {
    "planned": "runs of the study: done, missing, stale and corrupt",
    "done": "whole, and what the config asks for",
    "missing": "without a file",
    "stale": "whole, but of another blade, solver or setting",
    "corrupt": "not readable to their end, or not as their manifest says that they were written",
    "unbounded": "of those done, the ones that exceeded the displacement limit",
    "unconverged": "of those done, the ones in which the contact forces of some step did not converge",
    "longer_planned": "longer runs that show whether the growth of those done lasts",
    "longer_done": "of these, the ones that are done",
    "bytes": "disk that the folders of the runs take, with what is archived and no longer planned",
}
"""What is counted of a coating, or of all."""


def total(inventories: Iterable[Mapping[str, int]]) -> dict[str, int]:
    """Add up `COUNTS`."""
    parts = list(inventories)
    return {name: sum(part[name] for part in parts) for name in COUNTS}


def take(
    config: Mapping[str, Any],
    plan: CoatingPlan,
    folder: str | Path,
    blade_digest: str | None,
    thorough: bool = False,
) -> tuple[dict[str, int], list[Path]]:
    """Compare the runs of one coating in `folder` with its `plan`: `COUNTS`, and the damaged files.

    Without a blade, whose digest is `bladerub.study.cache.blade_digest`, every run that is there is stale. If
    `thorough`, every number is read, and every byte compared with the checksum in the manifest if the job is
    done; otherwise only what shows a truncated file.
    """
    folder, settings = Path(folder), config["analysis"]["divergence"]
    damaged = damaged_files(folder / "manifest.tsv", thorough=thorough)

    def look(run: PlannedRun) -> tuple[str, StoredRun | None]:
        path = folder / run.file
        if not path.exists():
            return "missing", None
        if path in damaged:
            return "corrupt", None
        try:
            stored = read_run(path, ALL if thorough else {"revolution_amplitude"})
        except Exception:  # h5py raises anything on a damaged file
            damaged.append(path)
            return "corrupt", None
        current = blade_digest is not None and stored.attributes["run_key"] == run.key(blade_digest)
        return ("done" if current else "stale"), stored

    counts = dict.fromkeys(COUNTS, 0) | {"planned": len(plan.runs)}
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
    counts["bytes"] = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    return counts, damaged
