"""Find the ridges of the chart, and what the heights and speeds of its peaks follow."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.chart import ridge, stiffening
from bladerub.extras.chart.table import read_points
from bladerub.extras.plots.chart_peaks import chart_explanation, chart_stiffening
from bladerub.settings.study import typed
from bladerub.workflow import outputs

config, unit = typed(snakemake.config), snakemake.params.modulus_unit
points = list(read_points(snakemake.input.manifests))
ridges, peaks = ridge.table(config, points), stiffening.explanation(config, points)
speeds = stiffening.table(peaks, read_reduced_blade(snakemake.input.blade))
outputs.save(
    snakemake, ridge=ridges, ridge_summary=ridge.summary(ridges), explanation=peaks, stiffening=speeds
)
outputs.save(snakemake, chart_explanation(peaks, unit), "chart_explanation_")
outputs.save(snakemake, chart_stiffening(peaks, speeds, unit), "chart_stiffening_")
