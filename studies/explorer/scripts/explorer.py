"""Write the whole study to one page."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.frequencies import ACCURACY_COLUMNS, doubts
from bladerub.extras.explorer.page import build
from bladerub.extras.further_columns import with_further
from bladerub.io import atomic, tables
from bladerub.study import divergence, peaks

accuracy = tables.read(snakemake.input.accuracy, ACCURACY_COLUMNS)
shown = [
    tables.read(snakemake.input.peaks, peaks.COLUMNS),
    tables.read(snakemake.input.divergence, divergence.COLUMNS),
]
if snakemake.input.bands:
    shown = [with_further(table, path) for table, path in zip(shown, snakemake.input.bands, strict=True)]
page = build(
    snakemake.input.maps,
    snakemake.input.manifests,
    *shown,
    snakemake.params.settings
    | {"f1_hz": accuracy.f_fe[0], "doubts": doubts(accuracy, snakemake.params.nominal_speed)},
    snakemake.params.configs,
)
with atomic.writing(snakemake.output[0]) as stream:
    stream.write(page)
