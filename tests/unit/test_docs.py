"""Links, paths, names and commands in README.md, CONTRIBUTING.md, docs/ and studies/ lead somewhere."""

import ast
import re
import shlex
from pathlib import Path

import pandas as pd
import pytest

from bladerub import plugins
from bladerub.cli import parser
from bladerub.config.read import load
from bladerub.io import tables
from docs import snapshots
from docs.numbers import data_folders
from docs.research_notes import NOTES as SITE
from docs.research_notes import follow

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
STUDIES = ROOT / "studies"
BUILT = {DOCS / "_build", DOCS / "auto_gallery", DOCS / "notes"}
NOTES = STUDIES.glob("**/README.md")
PAGES = {
    page: page.read_text(encoding="utf-8")
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *DOCS.rglob("*.md"), *NOTES)
    if BUILT.isdisjoint(page.parents)
}
LINK = re.compile(r"\]\(([^)#]*)(?:#([^)]*))?\)")
HEADING = re.compile(r"^#+ (.+)$", re.M)
PATH = re.compile(r"(?<![\w/.])(?:src|tests|config|profiles)/[\w./-]*\w")
NAME = re.compile(r"(?<![\w/.])bladerub(?:\.\w+)+")
NOT_IN_GIT = {"src/bladerub/numerics/__pycache__"}
BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)
COMMAND = re.compile(r"`(bladerub [a-z-]+ [^`]*--[^`]*)`")
TERM = re.compile(r"^\* .*\. (?P<code>`.+)$", re.M)
PAGE = (ROOT / "docs" / "reference" / "equations.md").read_text(encoding="utf-8")
ROW = re.compile(r"^\| `(?P<tag>.+?)` \|.*\| `(?P<name>bladerub[\w.]*(?::[\w.]+)?)`[^|]*\|$", re.M)
ROWS = [row.groupdict() | {"tag": row["tag"].replace(r"\|", "|")} for row in ROW.finditer(PAGE)]
HOW_TO, STUDY = DOCS / "how-to", DOCS.parent / "studies" / "chart"
ORIGIN = {"version": "1"}


def has_heading(page, heading):
    """Whether a heading of the page has this name, as GitHub and the site make it."""
    titles = HEADING.findall(page.read_text(encoding="utf-8"))
    return heading in {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def test_every_link_leads_to_a_file_and_heading():
    assert sum(len(LINK.findall(text)) for text in PAGES.values()) > 100
    for page, text in PAGES.items():
        for path, heading in LINK.findall(text):
            target = (page.parent / path).resolve() if path else page
            there = "://" in path or (target.exists() and (not heading or has_heading(target, heading)))
            assert there or is_of_a_deleted_study(target), f"{page}: {path}#{heading}"


def is_of_a_deleted_study(target):
    """Whether this is the page of a study that is not there: the site makes plain text of such links."""
    return target.name == "README.md" and STUDIES in target.parents and not target.parent.exists()


@pytest.mark.extras
def test_every_path_named_is_in_the_repository():
    named = {(page, path) for page, text in PAGES.items() for path in set(PATH.findall(text)) - NOT_IN_GIT}
    assert len(named) > 50
    assert [(page, path) for page, path in named if not (ROOT / path).exists()] == []


@pytest.mark.extras
def test_every_name_of_the_package_exists():
    for page, text in PAGES.items():
        for name in set(NAME.findall(text)):
            assert definition(name)[1], f"{page}: {name}"
    assert definition("bladerub.contact.spec.RunSpec.speed")[1] is None


def definition(name):
    """Return the text of a file of the package and the node of a dotted name in it, a field included."""
    path, parts = ROOT / "src", name.split(".")
    while parts and (path / parts[0]).is_dir():
        path /= parts.pop(0)
    path /= f"{parts.pop(0)}.py" if parts and (path / f"{parts[0]}.py").exists() else "__init__.py"
    text = path.read_text(encoding="utf-8")
    node = ast.parse(text)
    for part in parts:
        node = next((child for child in getattr(node, "body", ()) if part in _defined_by(child)), None)
    return text, node


def _defined_by(node):
    targets = getattr(node, "targets", [getattr(node, "target", node)])
    return {getattr(target, "name", getattr(target, "id", None)) for target in targets}


def commands(text):
    for block in BLOCK.findall(text):
        lines = block.replace("\\\n", " ").splitlines()
        given = [line.split("|")[0] for line in lines if line.startswith(".venv/bin/bladerub ")]
        yield from (line.removeprefix(".venv/bin/") for line in given)
    yield from COMMAND.findall(text)


def parses(command):
    try:
        parser().parse_args(shlex.split(command, comments=True)[1:])
    except SystemExit as end:
        return end.code == 0  # --help
    return True


@pytest.mark.extras
def test_the_commands_of_pages_are_accepted():
    written = {(page, command) for page, text in PAGES.items() for command in commands(text)}
    assert len(written) > 20
    assert [(page, command) for page, command in written if not parses(command)] == []
    assert not parses("bladerub status --deep")


def test_the_glossary_names_keys_of_the_config_that_exist():
    config = load(ROOT / "config" / "config.yaml")
    glossary = PAGES[DOCS / "reference" / "glossary.md"]
    terms = [*TERM.finditer(glossary)]
    assert len(terms) == glossary.count("\n* ")
    named = {name for term in terms for name in re.findall(r"`([^`]+)`", term["code"])}
    keys = {name for name in named if not name.startswith("bladerub.")}
    assert len(keys) > 10
    for key in keys:
        group = config
        for part in key.split("."):
            assert part in group, key
            group = group[part]


def test_the_readme_is_short():
    assert len((ROOT / "README.md").read_bytes()) <= 9216


def test_the_index_names_every_equation_and_figure_of_the_model():
    tags = {row["tag"] for row in ROWS}
    assert {f"eq. ({number})" for number in range(1, 10)} <= tags
    assert {"Fig. 3", "Fig. 4", "Coulomb's law"} <= tags
    assert any("sin θ" in tag for tag in tags)
    assert len(ROWS) == PAGE.count("| `bladerub")


def test_every_function_of_the_index_bears_its_tag():
    for row in ROWS:
        text, node = definition(row["name"].replace(":", "."))
        is_module = isinstance(node, ast.Module)
        source = ast.get_docstring(node) if is_module else ast.get_source_segment(text, node)
        assert re.search(re.escape(row["tag"]) + r"(?!\d)", source), row


@pytest.mark.extras
@pytest.mark.parametrize(
    ("page", "site", "text", "followed"),
    [
        (HOW_TO, HOW_TO, "[a](../../studies/chart/README.md#accuracy)", "[a](../notes/chart.md#accuracy)"),
        (HOW_TO, HOW_TO, "[a](../../studies/of_nobody/README.md#accuracy) b", "a b"),
        (HOW_TO, HOW_TO, "[a](../gallery/07_own_law.py)", "[a](../auto_gallery/07_own_law.rst)"),
        (STUDY, SITE, "[a](../variations/README.md#robustness)", "[a](variations.md#robustness)"),
        (STUDY, SITE, "![a](images/chart_Y4.png)", "![a](../../studies/chart/images/chart_Y4.png)"),
    ],
)
def test_a_link_leads_to_the_page_of_the_site(page, site, text, followed):
    assert follow(text, page, site) == followed


def taken(tmp_path, name, table):
    source, target = tmp_path / f"{name}.csv", tmp_path / "taken" / f"{name}.csv"
    target.parent.mkdir(exist_ok=True)
    tables.write(source, table, ORIGIN, columns_files=plugins.files("columns.csv"))
    snapshots.take(source, target)
    assert tables.read_origin(target) == ORIGIN
    return tables.read(target)


@pytest.mark.extras
def test_runs_with_equal_outcome_are_counted_and_quoted_columns_kept_to_four_digits(tmp_path):
    columns = [*snapshots.COUNTED["long_runs"], "f_omega"]
    rows = [("theta", "f4", 500, "free", f_omega) for f_omega in (0.1, 0.2)]
    rows += [("theta", "f4", 500, "steady", 0.3)]
    counts = taken(tmp_path, "long_runs", pd.DataFrame(rows, columns=columns))
    assert list(counts.columns) == [*snapshots.COUNTED["long_runs"], "runs"]
    assert dict(zip(counts.verdict, counts.runs, strict=True)) == {"free": 2, "steady": 1}
    columns = [*snapshots.KEPT["calibration"], "claim"]
    table = pd.DataFrame([("start", "C1a", 0.123456, "yes", "modes agree")], columns=columns)
    kept = {"set": "start", "id": "C1a", "measured": 0.1235, "holds": "yes"}
    assert taken(tmp_path, "calibration", table).to_dict("records") == [kept]


@pytest.mark.extras
def test_a_snapshot_taken_of_itself_is_the_same(tmp_path):
    """Its columns are described, those of studies too."""
    paths = [
        path for folder in data_folders() for path in folder.glob("*.csv") if path.stem in snapshots.KEPT
    ]
    assert paths
    for path in paths:
        snapshots.take(path, tmp_path / path.name)
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()


def test_an_equal_snapshot_keeps_its_description(tmp_path):
    folder, made = tmp_path / "data", tmp_path / "results" / "tables"
    folder.mkdir()
    made.mkdir(parents=True)
    for name, value in (("findings", "no"), ("margins", "yes")):
        tables.write(folder / f"{name}.csv", pd.DataFrame({"holds": ["yes"]}), ORIGIN)
        tables.write(made / f"{name}.csv", pd.DataFrame({"holds": [value]}), {"version": "2"})
    snapshots.update(folder, tmp_path / "results")
    assert tables.read(folder / "findings.csv")["holds"].tolist() == ["no"]
    assert tables.read_origin(folder / "findings.csv") == {"version": "2"}
    assert tables.read_origin(folder / "margins.csv") == ORIGIN
