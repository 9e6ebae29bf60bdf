"""What made the tables of a study, and how to cite it."""

from collections.abc import Iterator
from datetime import UTC, datetime

import yaml

from bladerub.extras.report.results import Results, files
from bladerub.io.folders import ROOT
from bladerub.io.provenance import PREFIX, software


def lines(results: Results) -> Iterator[tuple[str, str]]:
    """List what made the tables, when the newest file was written (they hold no date), and what the page."""
    for name, value in results.origin.items():
        yield name.removeprefix(PREFIX).replace("_", " "), value
    newest = max(path.stat().st_mtime for path in files(results.config, results.folder))
    yield "newest file read", datetime.fromtimestamp(newest, UTC).strftime("%Y-%m-%d %H:%M UTC")
    yield "this page", software()


def citation() -> str:
    """Say how to cite the program and the paper, from CITATION.cff."""
    about = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    works = [f"{_authors(work)}: {work['title']}" for work in (about, *about["references"])]
    return f"{'; '.join(works)} (version {about['version']})."


def _authors(work: dict) -> str:
    return ", ".join(author.get("name") or author["family-names"] for author in work["authors"])
