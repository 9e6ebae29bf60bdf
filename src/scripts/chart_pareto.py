"""List and draw the coatings that no other betters in displacement and worn volume together."""

from bladerub.extensions.chart.choice import pareto
from bladerub.extensions.plots.chart_pareto import chart_pareto
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.workflow import job

job.log_to(snakemake.log[0])

chart = tables.read(snakemake.input.table)
front = pareto(chart, snakemake.params.limits)
tables.write(snakemake.output.table, front, provenance(snakemake.config))
style.save(chart_pareto(chart, front), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
