import re
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from docs.numbers import FOLDER, Tables, numbers_of
from docs.numbers.claims import changed_sentences, changes, update_readme
from docs.numbers.record import VALUES, values

ROOT = Path(__file__).parents[2]
NAME = re.compile(r"\{\{ (\w+) \}\}")
FILES = {page.stem: page for page in (ROOT / "docs").glob("[!_an]*/*.md")}
FILES |= {page.stem: page for page in (ROOT / "docs").glob("*.md")}
FILES |= {page.parent.name: page for page in ROOT.glob("studies/**/README.md")}
TEXTS = {name: page.read_text(encoding="utf-8") for name, page in FILES.items()}
PAGES = {name: text for name, text in TEXTS.items() if NAME.search(text)}
SENTENCES = pd.read_csv(FOLDER / "verdicts.csv")


@pytest.fixture(scope="module")
def tables():
    return Tables()


@pytest.mark.parametrize("page", sorted(PAGES))
def test_each_name_of_a_page_has_a_number_and_each_number_is_quoted(page, tables):
    assert set(NAME.findall(PAGES[page])) == set(numbers_of(page, tables))


@pytest.mark.extras
def test_the_numbers_are_those_on_record(tables):
    """A review sees in ``values.txt`` what a change does to the pages (``python -m docs.numbers.record``)."""
    assert values(tables) == VALUES.read_text(encoding="utf-8")


def test_no_sentence_was_written_for_another_verdict(tables):
    assert changed_sentences(SENTENCES, tables["findings"]) == []


@pytest.mark.extras
def test_each_sentence_is_on_its_page():
    texts = {page: " ".join(text.split()) for page, text in PAGES.items()}
    assert [line.sentence for line in SENTENCES.itertuples() if line.sentence not in texts[line.page]] == []


def test_the_readme_has_the_claims_of_the_tables(tables, tmp_path):
    page = shutil.copy(ROOT / "README.md", tmp_path)
    update_readme(Path(page), tables)
    assert Path(page).read_text(encoding="utf-8") == (ROOT / "README.md").read_text(encoding="utf-8")
    changed = Tables()
    changed["findings"] = tables["findings"].replace({"holds": {"partly": "no"}})
    update_readme(Path(page), changed)
    assert " 0 hold partly" in Path(page).read_text(encoding="utf-8")


@pytest.mark.parametrize("order", [1, -1])
def test_a_run_that_stays_within_the_limit_in_one_of_two_studies_is_a_change(order):
    studies = [
        pd.DataFrame({"id": ["C11a"], "claim": "", "measured": [growth], "unit": "1", "holds": "yes"})
        for growth in (float("inf"), 0.02)[::order]
    ]
    assert "C11a" in changes(*studies, ("first", "second"), values=True)


@pytest.fixture
def site(tmp_path):
    """A site of one page, `model`, with the numbers and tables of this one."""
    docs = tmp_path / "docs"
    ignored = shutil.ignore_patterns("__pycache__", "*-metadata.json")
    shutil.copytree(FOLDER, docs / "numbers", ignore=ignored)
    shutil.copytree(ROOT / "docs" / "data", docs / "data", ignore=ignored)
    (docs / "model.md").write_text("# Model\n\n{{ runs_soft }} runs, {{ worse_than_rigid }} times\n")
    (docs / "conf.py").write_text(
        f"import sys\nsys.path[:0] = [{str(docs)!r}, {str(tmp_path)!r}]\nroot_doc = 'model'\n"
        "extensions = ['myst_parser', 'docs.numbers']\nmyst_enable_extensions = ['substitution']\n"
    )
    return docs


def build(docs):
    """Build the site; return what the build says, and the text of its page if there is one."""
    command = [sys.executable, "-m", "sphinx", "-W", "-q", "-b", "text", str(docs), str(docs / "_build")]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.stderr, (docs / "_build" / "model.txt").read_text("utf-8") if done.returncode == 0 else None


@pytest.mark.slow
def test_a_changed_value_changes_the_page_and_a_removed_one_fails_the_build(site):
    assert build(site) == ("", "Model\n*****\n\n1,152 runs, 2.4 times\n")
    peaks = site / "data" / "peaks.csv"
    values = pd.read_csv(peaks)
    chosen = (values[["casing", "E", "K", "theta", "order"]] == ["2nd", 1.1, 1, 0, 4]).all(axis="columns")
    values.loc[chosen, "amplitude"] *= 2
    values.to_csv(peaks, index=False)
    assert build(site) == ("", "Model\n*****\n\n1,152 runs, 4.8 times\n")
    values[~chosen].to_csv(peaks, index=False)
    assert "0 rows with {'casing': '2nd', 'E': 1.1, 'K': 1, 'theta': 0.0, 'order': 4}" in build(site)[0]
