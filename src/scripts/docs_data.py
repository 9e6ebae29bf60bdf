"""Take snapshots of the tables that pages quote, if any are given, and render the pages from them."""

import tempfile
from pathlib import Path

from bladerub.io import atomic, tables
from bladerub.workflow import job, pages

# The runs of a coating are counted by these columns: one row a run would be 1.4 MB
OUTCOME = ["casing", "E", "K", "theta", "law", "revolutions", "status", "divergent", "saturating"]

job.log_to(snakemake.log[0])


def count_outcomes(path: Path, counted: Path) -> None:
    """Write the table at `path`, a row a run, as counts of runs with their description."""
    runs = tables.read(path).groupby(OUTCOME, as_index=False).size().rename(columns={"size": "runs"})
    tables.write(counted, runs, tables.read_origin(path))


folder = Path("docs/data")
folder.mkdir(exist_ok=True)
with tempfile.TemporaryDirectory() as scratch:
    for table in map(Path, snakemake.input):
        if table.stem == "divergence":
            count_outcomes(table, Path(scratch) / table.name)
            table = Path(scratch) / table.name
        snapshot = folder / table.name
        # An equal table keeps the description of the study that it was first taken from
        if not snapshot.exists() or snapshot.read_bytes() != table.read_bytes():
            tables.copy(table, snapshot)
data = pages.read_tables(folder)
for page in pages.pages_of(Path()):
    text = page.read_text(encoding="utf-8")
    rendered = pages.render(text, str(page), data)
    if rendered != text:
        with atomic.writing(page) as stream:
            stream.write(rendered)
    for difference in pages.differences(rendered, str(page), data):
        print(difference)
