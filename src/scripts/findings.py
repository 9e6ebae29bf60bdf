"""Judge the claims of the paper."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.settings.study import typed
from bladerub.study import findings
from bladerub.study.findings.evidence import read_rom_accuracy
from bladerub.study.maps import read_map
from bladerub.workflow import outputs

table = findings.table(
    typed(snakemake.config),
    map(read_map, snakemake.input.maps),
    snakemake.input.peaks,
    snakemake.input.divergence,
    read_rom_accuracy(snakemake.input.rom_accuracy),
)
outputs.save(snakemake, table=table)
