"""Collect the runs of one coating in a map over angle, engine order and speed."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.study.grid import case_from_name
from bladerub.study.maps import build_map

build_map(
    snakemake.config,
    case_from_name(snakemake.config, snakemake.wildcards.coating),
    read_reduced_blade(snakemake.input.blade),
    Path(snakemake.input.manifest).parent,
    snakemake.output[0],
)
