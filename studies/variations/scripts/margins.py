"""Judge the claims again on parts of the study, to see what decides the verdicts."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import margins
from bladerub.extras.variations.verdicts import side_by_side, verdicts
from bladerub.settings.study import typed

config, inputs = typed(snakemake.config), snakemake.input
table = margins.table(config, inputs.maps, inputs.rom_accuracy)
outputs.save(snakemake, verdicts(side_by_side(table, by="variation")), table=table)
