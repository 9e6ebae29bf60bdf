"""Compute the points of one column of the chart that are missing or stale, then write its manifest."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.chart.column import compute_missing
from bladerub.extras.chart.point import POINTS, PointRow
from bladerub.settings.study import typed
from bladerub.study.cache import blade_digest
from bladerub.study.manifest import write_manifest

path = Path(snakemake.output[0])
rows = compute_missing(
    typed(snakemake.config),
    snakemake.params.plan,
    read_reduced_blade(snakemake.input.blade),
    path.parents[1] / POINTS,
    blade_digest(snakemake.input.blade),
    report=job.log,
    threads=snakemake.threads,
)
write_manifest(path, rows, PointRow)
