"""Put the claims of the paper to the test."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study import findings

job.log_to(snakemake.log[0])

table = findings.table(
    snakemake.config,
    map_paths=snakemake.input.maps,
    peaks_path=snakemake.input.peaks,
    divergence_path=snakemake.input.divergence,
    rom_accuracy_path=snakemake.input.rom_accuracy,
)
table["robustness"] = table["id"].map(snakemake.params.robustness)
tablefile.write(snakemake.output[0], table, provenance(snakemake.config))
