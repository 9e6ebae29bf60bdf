"""Compute the ensembles of one coating: the members that are missing or stale, then the file of all."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.ensembles import ensemble
from bladerub.settings.study import typed
from bladerub.study.cache import blade_digest
from bladerub.study.maps import read_map
from bladerub.workflow.progress import JobProgress

config, inputs, folder = typed(snakemake.config), snakemake.input, Path(snakemake.params.folder)
coating, blade, digest = read_map(inputs.map), read_reduced_blade(inputs.blade), blade_digest(inputs.blade)
progress, path = JobProgress(f"{coating.case.name}, ensemble", folder), snakemake.output[0]
rows = ensemble.make(config, coating, blade, digest, folder, path, progress, snakemake.threads)
progress.finish(rows)
