"""Judge the claims of the paper."""

import math

from bladerub.study import findings
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
table["robustness"] = [
    share if reference == holds else math.nan
    for (reference, share), holds in zip(known, table["holds"], strict=True)
]
outputs.save(snakemake, table=table)
