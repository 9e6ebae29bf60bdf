"""Snakemake's report of the tiny study: one page with every figure and its caption."""

import re

OUTSIDE = (
    "chart_",
    "friction",
    "identification",
    "laws",
    "long_runs",
    "rigs",
    "robustness",
    "rotor",
    "stress",
    "sweeps",
)
"""How captions of what `all` does not make begin."""


def test_the_report_is_one_page_with_every_figure(copied_study, tiny):
    done = copied_study.snakemake("--report", "report.html", config=tiny)
    assert done.returncode == 0, done.stderr
    page = (copied_study.folder / "report.html").read_text(encoding="utf-8")
    squeezed = " ".join(page.split())
    captions = (copied_study.folder / "src" / "report").glob("*.rst")
    for path in (path for path in captions if not path.name.startswith(OUTSIDE)):
        for paragraph in path.read_text(encoding="utf-8").split("\n\n"):  # the first is its name in the menu
            assert " ".join(paragraph.split())[:60].split('"')[0] in squeezed
    assert "fig08_spectrum_soft.png" in page
    assert "findings.csv" in page
    # nothing is loaded from elsewhere
    assert re.findall(r"<(?:script|link|img)[^>]+(?:src|href)=\"(?:https?:)?//[^\"]+", page) == []
