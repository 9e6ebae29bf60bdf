"""Compute one passage of one coating through the speeds."""

import sys

from bladerub.blade.model import read_reduced_blade
from bladerub.extensions import sweeps
from bladerub.study.grid import case_from_name
from bladerub.workflow import job

job.log_to(snakemake.log[0])

passage = snakemake.wildcards
result = sweeps.make(
    snakemake.config,
    case_from_name(snakemake.config, passage.coating),
    read_reduced_blade(snakemake.input.blade),
    passage.direction,
    float(passage.rate),
    snakemake.output[0],
)
print(result.message, file=sys.stderr)
