"""Put the claims of the paper to the test."""

import math

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.study import findings
from bladerub.workflow import job

job.log_to(snakemake.log[0])

table = findings.table(
    snakemake.config,
    map_paths=snakemake.input.maps,
    peaks_path=snakemake.input.peaks,
    divergence_path=snakemake.input.divergence,
    rom_accuracy_path=snakemake.input.rom_accuracy,
)
# a smaller study that says otherwise already at our own values tells nothing of what the others do
known = [snakemake.params.robustness.get(id_, ("", math.nan)) for id_ in table["id"]]
table["robustness"] = [
    share if reference == holds else math.nan
    for (reference, share), holds in zip(known, table["holds"], strict=True)
]
tables.write(snakemake.output[0], table, provenance(snakemake.config))
