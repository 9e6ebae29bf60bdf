"""Draw where the coatings of the chart keep the limits, and which of them they break elsewhere."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.chart_safe import chart_safe
from bladerub.study.chart.choice import broken_limits

job.log_to(snakemake.log[0])

chart = tablefile.read(snakemake.input.table)
figure = chart_safe(chart, broken_limits(chart, snakemake.params.limits), snakemake.params.limits)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
