"""Draw where the coatings of the chart keep the limits, and which of them they break elsewhere."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.choice import broken_limits
from bladerub.extras.chart.stress import read_chart
from bladerub.extras.plots.chart_moduli import chart_safe
from bladerub.workflow import outputs

chart = read_chart(*snakemake.input.tables)
settings = snakemake.params
figure = chart_safe(chart, broken_limits(chart, settings.limits), settings.limits, settings.modulus_unit)
outputs.save(snakemake, figure)
