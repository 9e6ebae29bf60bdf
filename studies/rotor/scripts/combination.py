"""Compute the missing or stale rows of one combination of speed and coating, then write the manifest."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.study.cache import blade_digest
from bladerub.study.job import compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.workflow.progress import of_job

folder = Path(snakemake.params.folder)
progress = of_job(folder.name, folder)
blade = read_reduced_blade(snakemake.input.blade), folder, blade_digest(snakemake.input.blade)
rows = compute_missing(snakemake.config, snakemake.params.plan, *blade, progress, snakemake.threads)
write_manifest(snakemake.output[0], rows)
progress.finish(rows)
