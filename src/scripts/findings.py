"""Judge the claims of the paper."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import Evidence, read_rom_accuracy
from bladerub.study.maps import read_map

inputs = snakemake.input
measured_on = {
    "peaks": tables.read(inputs.peaks, peaks.COLUMNS),
    "divergence": tables.read(inputs.divergence, divergence.COLUMNS),
    "rom_accuracy": read_rom_accuracy(inputs.rom_accuracy),
}
evidence = Evidence(typed(snakemake.config), measured_on, map(read_map, inputs.maps))
outputs.save(snakemake, table=findings.judge(evidence))
