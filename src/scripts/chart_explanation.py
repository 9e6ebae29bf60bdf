"""Set the height of the peaks beside the stiffness of the contact, the energy that is lost and the lobes."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.chart_explanation import chart_explanation
from bladerub.provenance import provenance
from bladerub.study.chart.explanation import table
from bladerub.study.chart.table import read_cells

job.log_to(snakemake.log[0])

peaks = table(snakemake.config, read_cells(snakemake.input.manifests))
tablefile.write(snakemake.output.table, peaks, provenance(snakemake.config))
style.save(chart_explanation(peaks), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
