"""Find the alternating stress of the blade for each coating of the chart."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.chart.table import read_points, stresses, table
from bladerub.settings.study import typed

config, blade = typed(snakemake.config), read_reduced_blade(snakemake.input.blade)
chart = table(config, read_points(snakemake.input.manifests))
outputs.save(snakemake, table=stresses(snakemake.input.mesh, blade, config, chart))
