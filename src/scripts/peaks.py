"""Find the resonant peaks of every coating."""

import sys

from bladerub.study import peaks

sys.stderr = open(snakemake.log[0], "w", buffering=1)

peaks.table(snakemake.config, snakemake.input.maps).to_csv(snakemake.output[0], index=False)
