"""Judge the long runs of all coatings after more and more of their revolutions."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.passages import long_runs
from bladerub.extras.plots.passages import long_runs as draw
from bladerub.settings.study import typed

coatings = [long_runs.read(path) for path in snakemake.input.long]
table = long_runs.table(typed(snakemake.config), coatings)
outputs.save(snakemake, draw(coatings, table), table=table)
