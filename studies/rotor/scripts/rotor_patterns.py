"""Tables of rows of blades whose worn pattern is followed."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor.plan import read_plan
from bladerub.extras.rotor.summary import drifts, patterns
from bladerub.settings.study import typed

config = typed(snakemake.config)
plan = read_plan(snakemake.input.plan, config)
followed = patterns(config, read_reduced_blade(snakemake.input.blade), plan)
outputs.save(snakemake, table=followed, drift=drifts(followed))
