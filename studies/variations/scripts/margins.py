"""Judge the claims again on parts of the study, to see what decides the verdicts."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations.verdicts import margins, side_by_side, verdicts
from bladerub.settings.study import typed

table = margins(typed(snakemake.config), snakemake.input.maps, snakemake.input.rom_accuracy)
outputs.save(snakemake, verdicts(side_by_side(table, by="variation")), table=table)
