"""Put the whole study into one page."""

from bladerub import atomic, job, tablefile
from bladerub.explorer.page import build
from bladerub.study import divergence, peaks

job.log_to(snakemake.log[0])

page = build(
    snakemake.input.maps,
    snakemake.input.manifests,
    tablefile.read(snakemake.input.peaks, peaks.COLUMNS),
    tablefile.read(snakemake.input.divergence, divergence.COLUMNS),
    snakemake.params.settings,
    snakemake.params.configs,
)
with atomic.writing(snakemake.output[0]) as stream:
    stream.write(page)
