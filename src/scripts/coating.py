"""Compute the runs of one folder that are missing or stale, then write its manifest."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.study.cache import blade_digest
from bladerub.study.job import compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.workflow.progress import of_job

plan = snakemake.params.plan
folder = Path(snakemake.params.folder)
progress = of_job(folder.name, folder)
rows = compute_missing(
    snakemake.config,
    plan,
    read_reduced_blade(snakemake.input.blade),
    folder,
    blade_digest(snakemake.input.blade),
    report=progress,
    threads=snakemake.threads,
)
write_manifest(snakemake.output[0], rows)
progress.finish(rows)
