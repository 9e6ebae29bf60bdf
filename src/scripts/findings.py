"""Put the claims of the paper to the test."""

import sys

from bladerub import tablefile
from bladerub.provenance import provenance
from bladerub.study import findings

sys.stderr = open(snakemake.log[0], "w", buffering=1)

table = findings.table(
    snakemake.config,
    map_paths=snakemake.input.maps,
    peaks_path=snakemake.input.peaks,
    divergence_path=snakemake.input.divergence,
    rom_accuracy_path=snakemake.input.rom_accuracy,
)
tablefile.write(snakemake.output[0], table, provenance(snakemake.config))
