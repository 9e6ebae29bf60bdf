"""Compute the rows of one combination that are missing or stale, then write their manifest."""

from pathlib import Path

from bladerub.blade.model import read_reduced_blade
from bladerub.extensions.rotor.plan import read_plan, without_confirmation
from bladerub.study.cache import blade_digest
from bladerub.study.job import compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.workflow import job
from bladerub.workflow.progress import of_job

job.log_to(snakemake.log[0])

name, folder = snakemake.wildcards.combination, Path(snakemake.params.folder)
config = without_confirmation(snakemake.config)
progress = of_job(name, folder)
rows = compute_missing(
    config,
    read_plan(snakemake.params.plan, config).runs(config, name),
    read_reduced_blade(snakemake.input.blade),
    folder,
    blade_digest(snakemake.input.blade),
    report=progress,
)
write_manifest(snakemake.output[0], rows)
progress.finish(rows)
