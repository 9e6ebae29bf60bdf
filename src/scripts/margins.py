"""Judge the claims again on parts of the study, to see what decides the verdicts."""

from bladerub.plots.verdicts import verdicts as draw
from bladerub.study import margins
from bladerub.study.findings import verdicts
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

table = margins.table(snakemake.config, snakemake.input.maps, snakemake.input.rom_accuracy)
outputs.save(snakemake, draw(verdicts(table, by="variation")), table=table)
