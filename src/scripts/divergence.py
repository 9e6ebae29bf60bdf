"""Judge for every run whether it diverges."""

import sys

from bladerub.study import divergence

sys.stderr = open(snakemake.log[0], "w", buffering=1)

divergence.table(snakemake.config, snakemake.input.maps).to_csv(snakemake.output[0], index=False)
