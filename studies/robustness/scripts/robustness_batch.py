"""Make the small studies of some samples of the design, and judge the claims of their part in each."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.config import read as configuration
from bladerub.extras.robustness.design import batch
from bladerub.extras.robustness.plan import read_plan
from bladerub.extras.robustness.sample import judge
from bladerub.io import tables
from bladerub.io.provenance import provenance

plan = read_plan(snakemake.params.plan)
part = plan.parts[snakemake.wildcards.part]
samples = batch(snakemake.config, plan, part, snakemake.wildcards.batch)
blades = zip(snakemake.input.models, snakemake.input.accuracies, strict=True)
verdicts, cost = judge(part.name, samples, part.claims, blades)
origin = provenance({**snakemake.config, "robustness": configuration.load(snakemake.params.plan)})
tables.write(snakemake.output.verdicts, verdicts, origin)
tables.write(snakemake.output.cost, cost, origin)
