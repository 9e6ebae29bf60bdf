"""Simulate some sets of a wave: their targets and verdicts."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.config import read as configuration
from bladerub.extras.identification import sets
from bladerub.extras.identification.plan import read_plan
from bladerub.extras.identification.sample import simulate
from bladerub.io import tables
from bladerub.io.provenance import provenance

plan = read_plan(snakemake.params.plan)
batch = plan.batches(int(snakemake.wildcards.wave))[int(snakemake.wildcards.batch)]
positions = sets.positions([snakemake.input.sets])
results = simulate(
    snakemake.config,
    plan,
    {number: positions.loc[number].to_numpy() for number in batch if number in positions.index},
)
origin = provenance({**snakemake.config, "identification": configuration.load(snakemake.params.plan)})
for name, table in results._asdict().items():
    tables.write(snakemake.output[name], table, origin)
