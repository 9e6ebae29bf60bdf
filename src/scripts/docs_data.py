"""Take snapshots of the tables that pages quote, if any are given, and render the pages from them."""

import shutil
from pathlib import Path

from bladerub.io import atomic, tables
from bladerub.workflow import job, pages

job.log_to(snakemake.log[0])

folder = Path("docs/data")
folder.mkdir(exist_ok=True)
for table in snakemake.input:
    for source in (Path(table), tables.description_path(table)):
        shutil.copyfile(source, folder / source.name)
data = pages.read_tables(folder)
for page in pages.pages_of(Path()):
    text = page.read_text(encoding="utf-8")
    rendered = pages.render(text, str(page), data)
    if rendered != text:
        with atomic.writing(page) as stream:
            stream.write(rendered)
    for difference in pages.differences(rendered, str(page), data):
        print(difference)
