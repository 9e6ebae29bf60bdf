"""Measure the errors of runs drawn from the study."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.study_runs import study_runs
from bladerub.extras.verification.accuracy import table
from bladerub.extras.verification.verify import important_runs
from bladerub.settings.study import typed
from bladerub.workflow import outputs

config, maps = typed(snakemake.config), Path(snakemake.input.maps[0]).parent
runs_by_origin = {"all": study_runs(config), "important": important_runs(config, maps)}
blade = read_reduced_blade(snakemake.input.blade)
outputs.save(snakemake, table=table(blade, config, runs_by_origin, report=job.log))
