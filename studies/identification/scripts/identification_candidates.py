"""Choose the best sets of all waves, and draw their neighbours."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.identification import candidates, sets, summary
from bladerub.extras.identification.plan import read_plan
from bladerub.io import tables
from bladerub.io.provenance import provenance

plan = read_plan(snakemake.params.plan)
measured = summary.measured(snakemake.input.quantities)
verdicts = summary.verdicts(snakemake.input.verdicts)
candidate_rows = candidates.choose(plan, sets.positions(snakemake.input.sets), measured, verdicts)
table = candidates.as_table(plan, candidate_rows)
tables.write(snakemake.output.candidates, table, provenance(snakemake.config))
