"""Write the reference of the config from its schema."""

import sys
from pathlib import Path

from bladerub.config import load
from bladerub.config_reference import reference

sys.stderr = open(snakemake.log[0], "w", buffering=1)

schema, config = load(snakemake.input.schema), load(snakemake.input.config)
Path(snakemake.output[0]).write_text(reference(schema, config), encoding="utf-8")
