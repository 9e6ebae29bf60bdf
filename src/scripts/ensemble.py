"""Compute the ensembles of one coating: the members that are missing or stale, then the file of all."""

import sys
from pathlib import Path

from bladerub.blade.model import read_reduced_blade
from bladerub.study import ensemble
from bladerub.study.cache import blade_digest
from bladerub.study.maps import read_map
from bladerub.workflow import job
from bladerub.workflow.progress import JobProgress

job.log_to(snakemake.log[0])

folder, coating = Path(snakemake.params.folder), read_map(snakemake.input.map)
progress = JobProgress(
    f"{coating.case.name}, ensemble",
    log=sys.stderr,
    terminal=sys.__stderr__,
    turn=folder.with_name(".terminal.lock"),
)
rows = ensemble.make(
    snakemake.config,
    coating,
    read_reduced_blade(snakemake.input.blade),
    blade_digest(snakemake.input.blade),
    folder,
    snakemake.output[0],
    report=progress,
)
summary = progress.summary(rows)
print(summary, file=sys.stderr)
print(summary)
