"""Compute the ensembles of one coating: the members that are missing or stale, then the file of all."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.ensembles import ensemble
from bladerub.settings.study import typed
from bladerub.study.cache import blade_digest
from bladerub.study.maps import read_map

folder, coating = Path(snakemake.params.folder), read_map(snakemake.input.map)
progress = job.JobProgress(f"{coating.case.name}, ensemble", folder)
rows = ensemble.make(
    typed(snakemake.config),
    coating,
    read_reduced_blade(snakemake.input.blade),
    blade_digest(snakemake.input.blade),
    folder,
    snakemake.output[0],
    report=progress,
    threads=snakemake.threads,
)
progress.finish(rows)
