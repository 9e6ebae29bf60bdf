"""Compute the runs of one coating that are missing or stale, then write its manifest."""

import sys
from pathlib import Path

from bladerub.blade.model import read_reduced_blade
from bladerub.study.cache import blade_digest
from bladerub.study.job import compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.workflow import job
from bladerub.workflow.progress import JobProgress

job.log_to(snakemake.log[0])

plan = snakemake.params.plan
folder = Path(snakemake.params.folder)
progress = JobProgress(
    plan.case.name, log=sys.stderr, terminal=sys.__stderr__, turn=folder.with_name(".terminal.lock")
)
rows = compute_missing(
    snakemake.config,
    plan,
    read_reduced_blade(snakemake.input.blade),
    folder,
    blade_digest(snakemake.input.blade),
    report=progress,
)
write_manifest(snakemake.output[0], rows)
summary = progress.summary(rows)
print(summary, file=sys.stderr)
print(summary)
