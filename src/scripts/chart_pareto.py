"""List and draw the coatings that no other betters in displacement and worn volume together."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.chart_pareto import chart_pareto
from bladerub.provenance import provenance
from bladerub.study.chart.choice import pareto

job.log_to(snakemake.log[0])

chart = tablefile.read(snakemake.input.table)
front = pareto(chart, snakemake.params.limits)
tablefile.write(snakemake.output.table, front, provenance(snakemake.config))
style.save(chart_pareto(chart, front), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
