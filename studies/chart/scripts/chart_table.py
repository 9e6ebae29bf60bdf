"""Sum up every point of the chart."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.table import read_points, table
from bladerub.settings.study import typed
from bladerub.workflow import outputs

outputs.save(snakemake, table=table(typed(snakemake.config), read_points(snakemake.input.manifests)))
