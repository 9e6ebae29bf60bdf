"""Set the height of the peaks beside the stiffness of the contact, the energy that is lost and the lobes."""

from bladerub.extensions.chart.explanation import table
from bladerub.extensions.chart.table import read_points
from bladerub.extensions.plots.chart_explanation import chart_explanation
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.workflow import job

job.log_to(snakemake.log[0])

peaks = table(snakemake.config, read_points(snakemake.input.manifests))
tables.write(snakemake.output.table, peaks, provenance(snakemake.config))
style.save(chart_explanation(peaks), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
