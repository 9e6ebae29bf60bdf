"""Relate the height of the peaks to the stiffness of the contact, the energy that is lost and the lobes."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.explanation import table
from bladerub.extras.chart.table import read_points
from bladerub.extras.plots.chart_peaks import chart_explanation
from bladerub.workflow import outputs

peaks = table(snakemake.config, read_points(snakemake.input.manifests))
outputs.save(snakemake, chart_explanation(peaks, snakemake.params.modulus_unit), table=peaks)
