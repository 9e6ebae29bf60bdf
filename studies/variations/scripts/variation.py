"""Simulate some sets of inputs of a plan: the verdicts on the claims, and measures of them."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.config import read as configuration
from bladerub.extras.variations import candidates, waves
from bladerub.extras.variations.job import cases, judge
from bladerub.extras.variations.plan import read
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed

kind, name, path = snakemake.wildcards.kind, snakemake.wildcards.job, snakemake.params.plan
plan = read(kind, path)
positions = None
if name.startswith("candidates/"):
    positions = dict(enumerate(candidates.read(snakemake.input.sets).to_numpy()))
elif snakemake.input.sets:
    drawn = waves.read([snakemake.input.sets])
    positions = dict(zip(drawn.index, drawn.to_numpy(), strict=True))
results = judge(
    cases(typed(snakemake.config), plan, plan.jobs()[name], positions),
    snakemake.params.blades,
    snakemake.params.folder,
    report=job.log,
)
origin = provenance({**snakemake.config, kind: configuration.load(path)})
outputs.save(snakemake, origin=origin, **results)
