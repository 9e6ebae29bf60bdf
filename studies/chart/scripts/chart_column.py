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

path, plan, model = Path(snakemake.output[0]), snakemake.params.plan, snakemake.input.blade
config, blade, digest = typed(snakemake.config), read_reduced_blade(model), blade_digest(model)
folder = path.parents[1] / POINTS
rows = compute_missing(config, plan, blade, folder, digest, report=job.log, threads=snakemake.threads)
write_manifest(path, rows, PointRow)
