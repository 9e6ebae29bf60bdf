"""Write the whole study to one page."""

from bladerub.explorer.page import build
from bladerub.io import atomic, tables
from bladerub.study import divergence, peaks
from bladerub.workflow import job

job.log_to(snakemake.log[0])

page = build(
    snakemake.input.maps,
    snakemake.input.manifests,
    tables.read(snakemake.input.peaks, peaks.COLUMNS),
    tables.read(snakemake.input.divergence, divergence.COLUMNS),
    snakemake.params.settings,
    snakemake.params.configs,
)
with atomic.writing(snakemake.output[0]) as stream:
    stream.write(page)
