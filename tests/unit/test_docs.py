import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
LINK = re.compile(r"\]\(([^)#]+)(?:#[^)]*)?\)|<img[^>]* src=\"([^\"]+)\"")


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_every_link_leads_to_a_file(page):
    links = [first or second for first, second in LINK.findall(page.read_text(encoding="utf-8"))]
    local = [link for link in links if not link.startswith(("http://", "https://", "mailto:"))]
    assert [link for link in local if not (page.parent / link).exists()] == []


def test_the_pictures_are_small_and_all_are_shown():
    pictures = set((ROOT / "docs" / "images").glob("*"))
    assert sum(picture.stat().st_size for picture in pictures) < 2e6
    shown = " ".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert [picture.name for picture in sorted(pictures) if picture.name not in shown] == []
