"""Write the reference of the config and its JSON schema from the models."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import sys
from pathlib import Path

sys.path.insert(0, str(Path.cwd()))  # for docs
from bladerub.config.read import load
from bladerub.extras.config import json_schema
from bladerub.io import atomic
from docs import config_keys

page = config_keys.updated(config_keys.PAGE.read_text("utf-8"), load(snakemake.input.config))
texts = {"reference": page, "schema": json_schema.text()}
for name, text in texts.items():
    with atomic.writing(snakemake.output[name]) as stream:
        stream.write(text)
