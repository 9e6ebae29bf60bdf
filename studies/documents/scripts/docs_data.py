"""Take the tables that pages quote, record the numbers, and write the table of claims in the README."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import sys
from pathlib import Path

sys.path.insert(0, str(Path.cwd()))  # for docs
from docs import snapshots
from docs.numbers import data_folders
from docs.numbers.record import record

for folder in data_folders(Path()):
    snapshots.update(folder, Path(snakemake.params.results))
record()
