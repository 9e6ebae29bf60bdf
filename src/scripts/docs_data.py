"""Take snapshots of the tables that pages quote, if any are given, and render the pages from them."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import tempfile
from pathlib import Path

from bladerub.io import atomic, tables
from bladerub.workflow import pages, snapshots

folder = Path(snakemake.params.get("folder", "docs/data"))
folder.mkdir(parents=True, exist_ok=True)
with tempfile.TemporaryDirectory() as scratch:
    for table in map(Path, snakemake.input):
        taken = Path(scratch) / table.name
        snapshot = folder / (snakemake.params.get("prefix", "") + table.name)
        snapshots.take(table, taken, snakemake.params.get("only", {}))
        # An equal table keeps the description of the study that it was first taken from
        if not snapshot.exists() or snapshot.read_bytes() != taken.read_bytes():
            tables.copy(taken, snapshot)
data = pages.read_tables(Path("docs/data"))
for page in pages.pages_of(Path()):
    text = page.read_text(encoding="utf-8")
    rendered = pages.render(text, str(page), data)
    if rendered != text:
        with atomic.writing(page) as stream:
            stream.write(rendered)
    for difference in pages.differences(rendered, str(page), data):
        print(difference)
