"""Tabulate and draw the chart: its quantities, what the limits leave, and what its peaks follow."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.chart import stiffening, table
from bladerub.extras.plots.chart_moduli import chart_map, chart_safe
from bladerub.extras.plots.chart_peaks import chart_explanation, chart_pareto, chart_stiffening
from bladerub.settings.study import typed

config, unit = typed(snakemake.config), snakemake.params.modulus_unit
points, limits = list(table.read_points(snakemake.input.manifests)), config.chart.limits
outputs.save(snakemake, table=table.table(config, points))
# as the table has it, with the stress where that is limited
chart = table.read_chart(snakemake.output.table, *snakemake.input.stress)
ridges, peaks = stiffening.ridges(config, points), stiffening.explanation(config, points)
speeds = stiffening.table(peaks, read_reduced_blade(snakemake.input.blade))
front = table.pareto(chart, limits)
frames = {"pareto": front, "choice": table.recommended(chart, limits), "ridge": ridges}
frames |= {"ridge_summary": stiffening.ridge_summary(ridges), "explanation": peaks, "stiffening": speeds}
outputs.save(snakemake, **frames)
figures = {quantity: chart_map(chart, quantity, unit) for quantity in snakemake.params.quantities} | {
    "safe": chart_safe(chart, table.broken_limits(chart, limits), limits, unit),
    "pareto": chart_pareto(chart, front),
    "explanation": chart_explanation(peaks, unit),
    "stiffening": chart_stiffening(peaks, speeds, unit),
}
for name, figure in figures.items():
    outputs.save(snakemake, figure, f"chart_{name}_")
