"""Simulate some sets of inputs of a plan: the verdicts on the claims, and measures of them."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.config import read as configuration
from bladerub.extras.variations import waves
from bladerub.extras.variations.job import cases, judge
from bladerub.extras.variations.plan import read
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed

kind, name, params = snakemake.wildcards.kind, snakemake.wildcards.job, snakemake.params
plan, positions = read(kind, params.plan), None
if name.startswith("candidates/"):
    positions = dict(enumerate(waves.read([snakemake.input.sets], waves.CANDIDATE).to_numpy()))
elif snakemake.input.sets:
    drawn = waves.read([snakemake.input.sets])
    positions = dict(zip(drawn.index, drawn.to_numpy(), strict=True))
small_studies = cases(typed(snakemake.config), plan, plan.jobs()[name], positions)
results = judge(small_studies, params.blades, params.folder, report=job.log)
origin = provenance({**snakemake.config, kind: configuration.load(params.plan)})
outputs.save(snakemake, origin=origin, **results)
