"""Links, paths and names in README.md, CONTRIBUTING.md, docs/ and studies/ lead somewhere."""

import ast
import re
from pathlib import Path

from bladerub.config.read import load

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
TERM = re.compile(r"^\* .*\. (?P<code>`.+)$", re.M)


def has_heading(page, heading):
    """Whether a heading of the page has this name, as GitHub and the site make it."""
    titles = HEADING.findall(page.read_text(encoding="utf-8"))
    return heading in {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def test_every_link_leads_to_a_file_and_heading():
    for page, text in PAGES.items():
        for path, heading in LINK.findall(text):
            target = (page.parent / path).resolve() if path else page
            there = "://" in path or (target.exists() and (not heading or has_heading(target, heading)))
            assert there or is_of_a_deleted_study(target), f"{page}: {path}#{heading}"


def is_of_a_deleted_study(target):
    """Whether this is the page of a study that is not there: the site makes plain text of such links."""
    return target.name == "README.md" and STUDIES in target.parents and not target.parent.exists()


def test_no_formula_needs_the_network():
    """The site would load MathJax, and show the source of formulas where there is no network."""
    texts = PAGES | {path: path.read_text(encoding="utf-8") for path in (DOCS / "gallery").glob("*.py")}
    assert [page for page, text in texts.items() if re.search(r":math:|\$\$|\{math\}", text)] == []


def test_every_path_named_is_in_the_repository():
    for page, text in PAGES.items():
        for path in set(PATH.findall(text)) - NOT_IN_GIT:
            assert (ROOT / path).exists(), f"{page}: {path}"


def test_every_name_of_the_package_exists():
    for page, text in PAGES.items():
        for name in set(NAME.findall(text)):
            assert is_defined(name), f"{page}: {name}"
    assert not is_defined("bladerub.contact.spec.RunSpec.speed")


def is_defined(name):
    """Whether a dotted name is a module of the package, or defined in one: a field of a class as well."""
    path, parts = ROOT / "src", name.split(".")
    while parts and (path / parts[0]).is_dir():
        path /= parts.pop(0)
    if not parts:
        return True
    path /= f"{parts.pop(0)}.py" if (path / f"{parts[0]}.py").exists() else "__init__.py"
    node = ast.parse(path.read_text(encoding="utf-8"))
    for part in parts:
        node = next((child for child in node.body if part in _defined_by(child)), None)
        if node is None:
            return False
    return True


def _defined_by(node):
    targets = getattr(node, "targets", [getattr(node, "target", node)])
    return {getattr(target, "name", getattr(target, "id", None)) for target in targets}


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
