"""Choose the best sets of all waves, and draw their neighbours."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import candidates, waves
from bladerub.extras.variations.identification import measured
from bladerub.extras.variations.job import VERDICTS
from bladerub.extras.variations.job import read as read_jobs
from bladerub.extras.variations.plan import read

plan = read("identification", snakemake.params.plan)
quantities = measured(snakemake.input.quantities)
verdicts = read_jobs(snakemake.input.verdicts, VERDICTS)
candidate_rows = candidates.choose(plan, waves.read(snakemake.input.sets), quantities, verdicts)
outputs.save(snakemake, candidates=candidates.as_table(plan, candidate_rows))
