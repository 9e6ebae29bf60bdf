"""Judge one candidate or neighbour by all claims."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.identification import candidates
from bladerub.extras.identification.plan import read_plan
from bladerub.io import tables
from bladerub.io.provenance import provenance

plan = read_plan(snakemake.params.plan)
candidate_rows = candidates.read(snakemake.input.candidates)
numbers = int(snakemake.wildcards.candidate), int(snakemake.wildcards.neighbour)
verdicts = candidates.judge(snakemake.config, plan, candidate_rows, *numbers)
tables.write(snakemake.output.verdicts, verdicts, provenance(snakemake.config))
