"""Draw one quantity of the chart over E and K, for each theta."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.chart_map import chart_map

job.log_to(snakemake.log[0])

figure = chart_map(tablefile.read(snakemake.input.table), snakemake.wildcards.quantity)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
