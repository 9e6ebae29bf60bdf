"""Links of pages, as GitHub follows them, lead to pages of the site."""

import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
sys.path.append(str(DOCS))
from research_notes import NOTES, follow  # noqa: E402

HOW_TO, STUDY = DOCS / "how-to", DOCS.parent / "studies" / "chart"


@pytest.mark.parametrize(
    ("page", "site", "text", "followed"),
    [
        (HOW_TO, HOW_TO, "[a](../config.md#units)", "[a](../config.md#units)"),
        (HOW_TO, HOW_TO, "[a](../../studies/chart/README.md#accuracy)", "[a](../notes/chart.md#accuracy)"),
        (HOW_TO, HOW_TO, "[a](../../studies/of_nobody/README.md#accuracy) b", "a b"),
        (HOW_TO, HOW_TO, "[a](../gallery/07_own_law.py)", "[a](../auto_gallery/07_own_law.rst)"),
        (STUDY, NOTES, "[a](../variations/README.md#robustness)", "[a](variations.md#robustness)"),
        (STUDY, NOTES, "![a](images/chart_Y4.png)", "![a](../../studies/chart/images/chart_Y4.png)"),
    ],
)
def test_a_link_leads_to_the_page_of_the_site(page, site, text, followed):
    assert follow(text, page, site) == followed
