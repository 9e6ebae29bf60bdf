"""Put the claims of the paper to the test."""

import sys

from bladerub.study import findings

sys.stderr = open(snakemake.log[0], "w", buffering=1)

findings.table(
    snakemake.config,
    map_paths=snakemake.input.maps,
    peaks_path=snakemake.input.peaks,
    divergence_path=snakemake.input.divergence,
    rom_accuracy_path=snakemake.input.rom_accuracy,
).to_csv(snakemake.output[0], index=False)
