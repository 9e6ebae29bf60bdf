"""Compute the long runs of one coating."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.passages import long_runs
from bladerub.settings.study import typed
from bladerub.study.maps import read_map

long_runs.make(
    typed(snakemake.config),
    read_map(snakemake.input.map),
    read_reduced_blade(snakemake.input.blade),
    snakemake.output[0],
    report=job.log,
)
