"""What of the plan is on disk: runs done, missing, stale and corrupt, by coating."""

import os
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from bladerub.blade.files import is_built, missing_file
from bladerub.blade.validation import read_reduced_blade
from bladerub.contact.result import UNBALANCED
from bladerub.io.errors import DamagedFile, is_refused, message_for
from bladerub.settings.analysis import Divergence
from bladerub.settings.study import Config
from bladerub.study.cache import blade_digest
from bladerub.study.growth import needs_confirmation
from bladerub.study.manifest import read_manifest
from bladerub.study.plan import CoatingPlan, PlannedRun, growth_key, longer_run
from bladerub.study.store import read_run

COUNTS = {
    "planned": "runs of the study: done, missing, stale, corrupt and unreadable",
    "done": "whole, and what the config asks for",
    "missing": "without a file",
    "stale": "whole, but of another blade, solver or setting",
    "corrupt": "not readable to their end, or not as their manifest says that they were written",
    "unreadable": "that the system refuses to read: locked, forbidden, or on a failing disk",
    "unbounded": "of those done, the ones that exceeded the displacement limit",
    "unconverged": "of those done, the ones in which the contact forces of some step did not converge",
    "unbalanced": f"of those done, the ones whose energy ledger misses more than {UNBALANCED:g} of the work",
    "longer_planned": "longer runs that show whether the growth of those done lasts",
    "longer_done": "of these, the ones that are done",
    "bytes": "disk that the folders of the runs take, with what is archived and no longer planned",
}
"""What is counted of a coating, or of all."""


def total(inventories: Iterable[Mapping[str, int]]) -> dict[str, int]:
    """Add up `COUNTS`."""
    parts = list(inventories)
    return {name: sum(part[name] for part in parts) for name in COUNTS}


def current_blade(config: Config, model: Path) -> tuple[str | None, str | None]:
    """Return the digest of the reduced blade at `model`, or None and why there is none of this config."""
    try:
        if lost := missing_file(model):
            return None, f"any run that is there counts as stale without its blade: {lost} is missing"
        if not is_built(config, model):
            return None, f"the blade is of another config, so any run that is there counts as stale: {model}"
        read_reduced_blade(model)  # or it is no blade to compute with
        return blade_digest(model), None
    except OSError as error:
        return None, f"any run that is there counts as stale without its blade: {message_for(error)}"


class Inventory(NamedTuple):
    """What there is of the runs of a coating."""

    counts: dict[str, int]  # `COUNTS`
    damaged: list[Path]  # read, and not what they should be
    unreadable: list[str]  # for each file that the system refuses to read, its name, the reason and the cure


class _RunSummary(NamedTuple):
    """A whole run on disk, as its manifest or its file says."""

    key: str
    status: str
    unconverged_steps: int
    energy_residual: float
    grows: bool  # so that it needs a longer run


def take(
    config: Config, plan: CoatingPlan, folder: Path, digest: str | None, known: Collection[Path] = ()
) -> Inventory:
    """Compare the runs of one coating in `folder` with its `plan`; all are stale without a `digest`.

    A file of the size in the manifest is taken to be what that says; any other is opened. Those `known` to be
    damaged are corrupt (``FAULTS`` of `bladerub.plugins` reads all to their ends).
    """
    manifest = folder / "manifest.tsv"
    paths = (Path(place, name) for place, _, names in os.walk(folder) for name in names)
    sizes = {path: path.stat().st_size for path in paths if path.is_file()}
    manifest_runs, damaged, unreadable = {}, [], []
    try:
        manifest_runs = _listed(manifest, sizes, growth_key(config))
    except DamagedFile:
        damaged.append(manifest)

    def look(run: PlannedRun) -> tuple[str, _RunSummary | None]:
        path = folder / run.file
        if path not in sizes:
            return "missing", None
        if path in known:
            return "corrupt", None
        summary = manifest_runs.get(path)
        if summary is None:
            try:
                summary = _read(path, config.analysis.divergence)
            except Exception as error:  # h5py raises anything on a damaged file
                if is_refused(error):
                    unreadable.append(message_for(error))
                    return "unreadable", None
                damaged.append(path)
                return "corrupt", None
        current = digest is not None and summary.key == run.key(digest)
        return ("done" if current else "stale"), summary

    counts = dict.fromkeys(COUNTS, 0) | {"planned": len(plan.runs)}
    for run in plan.runs:
        state, summary = look(run)
        counts[state] += 1
        if summary is None or state != "done":
            continue
        counts["unbounded"] += summary.status == "unbounded"
        counts["unconverged"] += summary.unconverged_steps > 0
        counts["unbalanced"] += not summary.energy_residual <= UNBALANCED
        if run.follow and summary.grows:
            counts["longer_planned"] += 1
            counts["longer_done"] += look(longer_run(config, run))[0] == "done"
    counts["bytes"] = sum(sizes.values())
    return Inventory(counts, damaged, unreadable)


def _listed(manifest: Path, sizes: Mapping[Path, int], growth_key: str) -> dict[Path, _RunSummary]:
    """Take from the manifest, if there is one, what it says of whole files; the key is that of its job."""
    summaries = {}
    for row in read_manifest(manifest) if manifest in sizes else ():
        if row.growth_key != growth_key:
            continue
        files, outcome = row.files(manifest.parent), (row.status, row.unconverged_steps, row.energy_residual)
        for file, key in zip(files, (row.run_key, row.confirmation_key), strict=False):
            if sizes.get(file.path) == file.bytes:
                summaries[file.path] = _RunSummary(key, *outcome, grows=len(files) > 1)
    return summaries


def _read(path: Path, settings: Divergence) -> _RunSummary:
    stored = read_run(path, {"revolution_amplitude"})
    names = ("run_key", "status", "n_unconverged_steps", "energy_residual")
    key, status, unconverged_steps, residual = (stored.attributes[name] for name in names)
    grows = needs_confirmation(stored.data["revolution_amplitude"], status, settings)
    return _RunSummary(key, status, unconverged_steps, residual, grows)
