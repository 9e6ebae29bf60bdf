"""Sphinx extension: the page of a study, ``studies/…/<name>/README.md``, is ``notes/<name>`` on the site.

Pages link to files, as GitHub follows them. Here a link to the page of a study leads to its page of the site,
or is plain text where that study was deleted; a link to an example of the gallery leads to its output.
"""

import os
import re
from pathlib import Path

HERE = Path(__file__).parent
NOTES = HERE / "notes"
LINK = re.compile(r"\[([^\[\]]*)\]\(([^()#\s]+)(#[^()\s]*)?\)")


def _write_notes(app):
    """Write the pages of the studies that are there, those that changed alone, and remove those of others."""
    NOTES.mkdir(exist_ok=True)
    stale = set(NOTES.glob("*.md"))
    for readme in HERE.parent.glob("studies/**/README.md"):
        page = NOTES / f"{readme.parent.name}.md"
        text = follow(readme.read_text("utf-8"), readme.parent, NOTES)
        if not page.exists() or page.read_text("utf-8") != text:
            page.write_text(text, encoding="utf-8")
        stale.discard(page)
    for page in stale:
        page.unlink()


def _follow_links(app, docname, source):
    """Do with the links of a page of the site what `follow` says."""
    folder = (HERE / docname).parent
    if folder != NOTES:
        source[0] = follow(source[0], folder, folder)


def follow(text, folder, page_folder):
    """Return the text of a page in `folder` with the links that it needs on the site, in `page_folder`."""

    def link(match):
        words, target, heading = match.groups(default="")
        if "://" in target:
            return match[0]
        path = _page_of(Path(os.path.normpath(folder / target)))
        return f"[{words}]({os.path.relpath(path, page_folder)}{heading})" if path else words

    return LINK.sub(link, text)


def _page_of(path):
    """Return the file of the site for one of the repository; `None` for the page of a deleted study."""
    if path.name == "README.md" and HERE.parent / "studies" in path.parents:
        return NOTES / f"{path.parent.name}.md" if path.exists() else None
    if path.name in ("CONTRIBUTING.md", "CHANGELOG.md"):
        return HERE / path.name.lower()
    if HERE / "gallery" in (path, path.parent):
        return HERE / "auto_gallery" / ("index.rst" if path.name == "gallery" else f"{path.stem}.rst")
    return path


def setup(app):
    """Register the extension."""
    app.connect("builder-inited", _write_notes)
    app.connect("source-read", _follow_links)
    return {"parallel_read_safe": True}
