"""Rule `blade_tables`: the tables of the blade's accuracy, next to those of the study."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.frequencies import ACCURACY_COLUMNS, CAMPBELL_COLUMNS
from bladerub.io import tables

accuracy = snakemake.input[0]
campbell = tables.read(accuracy, ACCURACY_COLUMNS)[CAMPBELL_COLUMNS]
tables.write(snakemake.output.campbell, campbell, tables.read_origin(accuracy), float_format="%.10g")
tables.copy(accuracy, snakemake.output.rom_accuracy)
