"""Judge the claims of the paper."""

import math

from bladerub.study import bands, ensemble, findings
from bladerub.study.findings.evidence import read_rom_accuracy
from bladerub.study.maps import read_map
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

table = findings.table(
    snakemake.config,
    map_paths=snakemake.input.maps,
    peaks_path=snakemake.input.peaks,
    divergence_path=snakemake.input.divergence,
    rom_accuracy_path=snakemake.input.rom_accuracy,
)
# the robustness counts only where its own reference has the verdict of this study
known = [snakemake.params.robustness.get(id_, ("", math.nan)) for id_ in table["id"]]
table = bands.of_findings(
    snakemake.config,
    table,
    read_rom_accuracy(snakemake.input.rom_accuracy),
    list(map(read_map, snakemake.input.maps)),
    list(map(ensemble.read, snakemake.input.ensembles)),
)
table["robustness"] = [
    share if reference == holds else math.nan
    for (reference, share), holds in zip(known, table["holds"], strict=True)
]
outputs.save(snakemake, table=table)
