"""The page of the Python interface has the signatures of today: `python -m docs.signatures` writes them."""

from docs.signatures import PAGE, updated


def test_the_page_has_the_signatures_of_today():
    text = PAGE.read_text(encoding="utf-8")
    assert updated(text) == text
