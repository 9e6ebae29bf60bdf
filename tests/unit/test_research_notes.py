"""Links of pages, as GitHub follows them, lead to pages of the site."""

import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
sys.path.append(str(DOCS))
from research_notes import NOTES, follow  # noqa: E402


@pytest.mark.parametrize(
    ("text", "followed"),
    [
        ("[a](../config.md#units)", "[a](../config.md#units)"),
        ("[a](../../studies/chart/README.md#accuracy)", "[a](../notes/chart.md#accuracy)"),
        ("[a](../../studies/of_nobody/README.md#accuracy) b", "a b"),
        ("[a](../gallery/07_own_law.py)", "[a](../auto_gallery/07_own_law.rst)"),
        ("[a](../../CONTRIBUTING.md)", "[a](../contributing.md)"),
        ("[a](https://www.paraview.org)", "[a](https://www.paraview.org)"),
    ],
)
def test_a_page_of_the_documents(text, followed):
    folder = DOCS / "how-to"
    assert follow(text, folder, folder) == followed


@pytest.mark.parametrize(
    ("text", "followed"),
    [
        ("[a](../../docs/config.md)", "[a](../config.md)"),
        ("[a](../variations/robustness/README.md)", "[a](robustness.md)"),
        ("![a](images/chart_Y4.png)", "![a](../../studies/chart/images/chart_Y4.png)"),
    ],
)
def test_the_page_of_a_study(text, followed):
    assert follow(text, DOCS.parent / "studies" / "chart", NOTES) == followed
