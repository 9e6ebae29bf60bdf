"""Sphinx extension: the numbers of `docs.numbers` become MyST substitutions of the page of their name."""

import json
from pathlib import PurePosixPath

from docs import numbers


def _add_front_matter(app, docname, source):
    """Put the names of a page into its front matter, where MyST looks for them."""
    page = PurePosixPath(docname).name
    if not numbers.module_of(page).exists():
        return
    tables = numbers.Tables()
    substitutions = numbers.numbers_of(page, tables)
    front_matter = json.dumps({"substitutions": substitutions}, ensure_ascii=False)
    source[0] = f"---\nmyst: {front_matter}\n---\n{source[0]}"
    for path in (numbers.module_of(page), *numbers.FOLDER.glob("*.py"), *map(tables.path, tables)):
        app.env.note_dependency(str(path))


def setup(app):
    """Register the extension."""
    app.connect("source-read", _add_front_matter)
    return {"parallel_read_safe": True}
