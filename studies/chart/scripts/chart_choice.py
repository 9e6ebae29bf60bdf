"""Recommend a coating for each theta, and say how sure that is."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.choice import recommended
from bladerub.extras.chart.stress import read_chart
from bladerub.workflow import outputs

chart = read_chart(*snakemake.input.tables)
outputs.save(snakemake, table=recommended(chart, snakemake.params.limits))
