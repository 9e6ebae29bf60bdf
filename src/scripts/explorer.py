"""Put the whole study into one page."""

import sys
from pathlib import Path

import pandas as pd

from bladerub.explorer.page import build

sys.stderr = open(snakemake.log[0], "w", buffering=1)

page = build(
    snakemake.input.maps,
    snakemake.input.manifests,
    pd.read_csv(snakemake.input.peaks),
    pd.read_csv(snakemake.input.divergence),
    snakemake.params.settings,
    snakemake.params.configs,
)
Path(snakemake.output[0]).write_text(page, encoding="utf-8")
