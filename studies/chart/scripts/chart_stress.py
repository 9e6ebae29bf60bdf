"""Find the alternating stress of the blade for each coating of the chart."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.chart.stress import table
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.workflow import outputs

blade, chart = read_reduced_blade(snakemake.input.blade), tables.read(snakemake.input.table)
outputs.save(snakemake, table=table(snakemake.input.mesh, blade, typed(snakemake.config), chart))
