"""Links, pictures, paths and names in README.md, CONTRIBUTING.md and docs/ lead somewhere."""

import ast
import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "src"
DOCS = ROOT / "docs"
BUILT = {"_build", "auto_gallery"}
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted(path for path in DOCS.rglob("*.md") if BUILT.isdisjoint(path.relative_to(DOCS).parts)),
]
GLOSSARY = DOCS / "reference" / "glossary.md"
LINK = re.compile(r"\]\(([^)#]*)(?:#([^)]*))?\)")
HEADING = re.compile(r"^#+ (.+)$", re.M)
PATH = re.compile(r"(?<![\w/.])(?:src|tests|config|profiles)/[\w./-]*\w")
NAME = re.compile(r"(?<![\w/.])bladerub(?:\.\w+)+")
TEST_FILE = re.compile(r"(?<![\w/])test_\w+\.py")
NOT_IN_GIT = {"src/bladerub/contact/__pycache__"}
TERM_ROW = re.compile(r"^\| (?P<term>[^|]+) \| [^|]+ \| [^|]+ \| (?P<code>[^|]+) \| [^|]+ \|$", re.M)


def text_of(page):
    return page.read_text(encoding="utf-8")


def local_links(page):
    """Path and heading of each link of a page into the repository; no path is the page itself."""
    links = [(path, heading) for path, heading in LINK.findall(text_of(page)) if "://" not in path]
    return [(page.parent / path if path else page, heading) for path, heading in links]


def anchors(page):
    """Names of the headings of a page, as GitHub and the site make them."""
    return {
        re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in HEADING.findall(text_of(page))
    }


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_every_link_leads_to_a_file(page):
    assert [str(target) for target, _ in local_links(page) if not target.exists()] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_no_link_is_empty(page):
    assert [heading for path, heading in LINK.findall(text_of(page)) if not path and not heading] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_no_line_of_prose_has_more_than_400_characters(page):
    prose = re.sub(r"^```.*?^```", "", text_of(page), flags=re.M | re.S)
    lines = [line for line in prose.splitlines() if not line.lstrip().startswith("|")]
    too_long = [line for line in lines if len(line) > 400]
    assert too_long == [] or page.name == "config.md"  # which is made from the schema


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_every_link_to_a_heading_finds_it(page):
    named = [(target, heading) for target, heading in local_links(page) if heading]
    assert [(str(target), heading) for target, heading in named if heading not in anchors(target)] == []


def test_the_pictures_are_small_and_all_are_shown():
    pictures = set((DOCS / "images").glob("*"))
    assert sum(picture.stat().st_size for picture in pictures) < 2e6
    shown = " ".join(text_of(page) for page in PAGES)
    assert [picture.name for picture in sorted(pictures) if picture.name not in shown] == []


def test_no_formula_needs_the_network():
    """The site would load MathJax, and show the source of formulas where there is no network."""
    pages = [*PAGES, *(DOCS / "gallery").glob("*.py")]
    assert [page.name for page in pages if re.search(r":math:|\$\$|\{math\}", text_of(page))] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_every_path_named_is_in_the_repository(page):
    named = set(PATH.findall(text_of(page))) - NOT_IN_GIT
    assert sorted(path for path in named if not (ROOT / path).exists()) == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_every_test_file_named_exists(page):
    tests = {path.name for path in (ROOT / "tests").rglob("test_*.py")}
    assert sorted(set(TEST_FILE.findall(text_of(page))) - tests) == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_every_name_of_the_package_exists(page):
    assert sorted(name for name in set(NAME.findall(text_of(page))) if not is_defined(name)) == []


def is_defined(name):
    """Whether a dotted name is a module of the package, or defined in one: a field of a class as well."""
    path, parts = SOURCES, name.split(".")
    while parts and (path / parts[0]).is_dir():
        path /= parts.pop(0)
    if not parts:
        return True
    if (path / f"{parts[0]}.py").exists():
        path /= f"{parts.pop(0)}.py"
    else:
        path /= "__init__.py"
    node = ast.parse(text_of(path))
    for part in parts:
        found = [child for child in node.body if part in _defined_by(child)]
        if not found:
            return False
        node = found[0]
    return True


def _defined_by(node):
    targets = getattr(node, "targets", [getattr(node, "target", node)])
    return {getattr(target, "name", getattr(target, "id", None)) for target in targets}


@pytest.mark.parametrize(
    ("name", "defined"),
    [
        ("bladerub.contact", True),
        ("bladerub.contact.law", True),
        ("bladerub.contact.law.return_mapping", True),
        ("bladerub.contact.spec.RunSpec.f_omega", True),
        ("bladerub.blade.model.N_INTERFACE", True),
        ("bladerub.contact.rules", False),
        ("bladerub.contact.law.return_map", False),
        ("bladerub.contact.spec.RunSpec.speed", False),
    ],
)
def test_names_are_sought_in_the_sources(name, defined):
    assert is_defined(name) == defined


def glossary_tables():
    """Rows of the glossary, a list for each of its tables."""
    tables = text_of(GLOSSARY).split("\n## ")[1:]
    return [[row for row in TERM_ROW.finditer(table) if row["term"] != "term"] for table in tables]


def test_the_glossary_is_sorted_and_complete():
    tables = glossary_tables()
    assert [len(rows) > 20 for rows in tables] == [True, True]
    for rows in tables:
        terms = [row["term"].lower() for row in rows]
        assert terms == sorted(set(terms))
        assert all("`" in row["code"] for row in rows)


def test_the_glossary_names_keys_of_the_config_that_exist():
    config = yaml.safe_load(text_of(ROOT / "config" / "config.yaml"))
    named = {
        name for rows in glossary_tables() for row in rows for name in re.findall(r"`([^`]+)`", row["code"])
    }
    keys = {name for name in named if not name.startswith("bladerub.")}
    assert len(keys) > 10
    assert sorted(key for key in keys if not _is_key(config, key)) == []


def _is_key(group, key):
    for part in key.split("."):
        if part not in group:
            return False
        group = group[part]
    return True


def test_the_readme_is_short():
    assert len((ROOT / "README.md").read_bytes()) <= 9216
