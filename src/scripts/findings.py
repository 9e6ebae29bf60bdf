"""Judge the claims of the paper."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import math

from bladerub.study import findings
from bladerub.study.findings.evidence import read_rom_accuracy
from bladerub.study.maps import read_map
from bladerub.workflow import outputs

maps = [read_map(path) for path in snakemake.input.maps]
rom_accuracy = read_rom_accuracy(snakemake.input.rom_accuracy)
table = findings.table(
    snakemake.config, maps, snakemake.input.peaks, snakemake.input.divergence, rom_accuracy
)
# the robustness counts only where its own reference has the verdict of this study
robustness = [snakemake.params.robustness.get(id_, ("", math.nan)) for id_ in table["id"]]
table["robustness"] = [
    share if reference == holds else math.nan
    for (reference, share), holds in zip(robustness, table["holds"], strict=True)
]
outputs.save(snakemake, table=table)
