"""Compute one speed sweep of one coating."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.passages import sweeps
from bladerub.settings.study import typed
from bladerub.study.grid import case_from_name

config, wildcards = typed(snakemake.config), snakemake.wildcards
result = sweeps.make(
    config,
    case_from_name(config, wildcards.coating),
    read_reduced_blade(snakemake.input.blade),
    wildcards.direction,
    float(wildcards.rate),
    snakemake.output[0],
)
job.log(result.message)
