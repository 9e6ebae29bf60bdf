"""List and draw the coatings that no other improves on in both displacement and worn volume."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.choice import pareto
from bladerub.extras.chart.stress import read_chart
from bladerub.extras.plots.chart_pareto import chart_pareto
from bladerub.workflow import outputs

chart = read_chart(*snakemake.input.tables)
front = pareto(chart, snakemake.params.limits)
outputs.save(snakemake, chart_pareto(chart, front), table=front)
