"""Draw each quantity of the chart over E and K, for each theta."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.plots.chart_moduli import chart_map
from bladerub.io import tables
from bladerub.plots import style

chart = tables.read(snakemake.input.table)
for quantity, png, pdf in zip(
    snakemake.params.quantities, snakemake.output.png, snakemake.output.pdf, strict=True
):
    figure = chart_map(chart, quantity, snakemake.params.modulus_unit)
    style.save(figure, png, pdf, snakemake.params.dpi)
