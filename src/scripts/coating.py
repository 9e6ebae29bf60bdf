"""Compute the runs of a coating, or rows of blades, that are missing or stale, and write map and manifest."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed
from bladerub.study.cache import blade_digest
from bladerub.study.job import compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.study.maps import collect_listed, write_map

config, plan = typed(snakemake.config), snakemake.params.plan
folder = Path(snakemake.params.folder)
progress = job.JobProgress(folder.name, folder)
blade = read_reduced_blade(snakemake.input.blade)
digest = blade_digest(snakemake.input.blade)
rows = compute_missing(config, plan, blade, folder, digest, report=progress, threads=snakemake.threads)
if path := snakemake.output.get("map"):  # rows of blades have none
    write_map(path, collect_listed(config, plan.case, blade, folder, rows), provenance(config.plain()))
write_manifest(snakemake.output.manifest, rows)
progress.finish(rows)
