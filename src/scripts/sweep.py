"""Compute one speed sweep of one coating."""

import sys

from bladerub.blade.model import read_reduced_blade
from bladerub.extensions import sweeps
from bladerub.study.grid import case_from_name
from bladerub.workflow import job

job.log_to(snakemake.log[0])

asked = snakemake.wildcards
result = sweeps.make(
    snakemake.config,
    case_from_name(snakemake.config, asked.coating),
    read_reduced_blade(snakemake.input.blade),
    asked.direction,
    float(asked.rate),
    snakemake.output[0],
)
print(result.message, file=sys.stderr)
