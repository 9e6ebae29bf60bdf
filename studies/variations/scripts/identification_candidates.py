"""Choose the best sets of all waves, and draw their neighbours."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import waves
from bladerub.extras.variations.identification import measured
from bladerub.extras.variations.job import read as joined
from bladerub.extras.variations.plan import read

plan, inputs = read("identification", snakemake.params.plan), snakemake.input
sets, verdicts = waves.read(inputs.sets), joined(inputs.verdicts)
candidates = waves.choose(plan, sets, measured(inputs.quantities), verdicts)
outputs.save(snakemake, candidates=waves.with_values(plan, candidates))
