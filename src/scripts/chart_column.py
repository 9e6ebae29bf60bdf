"""Compute the cells of one column of the chart that are missing or stale, then write its manifest."""

import sys
from pathlib import Path

from bladerub.blade.model import read_reduced_blade
from bladerub.extensions.chart import manifest
from bladerub.extensions.chart.column import compute_missing
from bladerub.extensions.chart.grid import columns
from bladerub.study.key import blade_digest
from bladerub.workflow import job

job.log_to(snakemake.log[0])

path = Path(snakemake.output[0])
rows = compute_missing(
    snakemake.config,
    columns(snakemake.config)[snakemake.wildcards.column],
    read_reduced_blade(snakemake.input.blade),
    path.parents[1] / manifest.CELLS,
    blade_digest(snakemake.input.blade),
    report=lambda line: print(line, file=sys.stderr),
)
manifest.write(path, rows)
