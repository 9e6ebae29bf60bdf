"""Draw where the coatings keep the limits, list the best of them, and recommend one for each theta."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.choice import broken_limits, pareto, recommended
from bladerub.extras.chart.stress import read_chart
from bladerub.extras.plots.chart_moduli import chart_safe
from bladerub.extras.plots.chart_pareto import chart_pareto
from bladerub.settings.study import typed
from bladerub.workflow import outputs

chart, limits = read_chart(*snakemake.input.tables), typed(snakemake.config).chart.limits
front = pareto(chart, limits)
safe = chart_safe(chart, broken_limits(chart, limits), limits, snakemake.params.modulus_unit)
outputs.save(snakemake, pareto=front, choice=recommended(chart, limits))
outputs.save(snakemake, safe, "chart_safe_")
outputs.save(snakemake, chart_pareto(chart, front), "chart_pareto_")
