"""List and draw the coatings that no other improves on in both displacement and worn volume."""

from bladerub.extensions.chart.choice import pareto
from bladerub.extensions.plots.chart_pareto import chart_pareto
from bladerub.io import tables
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

chart = tables.read(snakemake.input.table)
front = pareto(chart, snakemake.params.limits)
outputs.save(snakemake, chart_pareto(chart, front), table=front)
