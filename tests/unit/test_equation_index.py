"""Each line of docs/reference/equations.md names a function whose source bears the tag of that line."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "reference" / "equations.md").read_text(encoding="utf-8")
ROW = re.compile(
    r"^\| `(?P<tag>.+?)` \|.*\| `(?P<module>bladerub[\w.]*)(?::(?P<name>[\w.]+))?`[^|]*\|$", re.M
)
ROWS = [row.groupdict() | {"tag": row["tag"].replace(r"\|", "|")} for row in ROW.finditer(PAGE)]


def source_of(module, name):
    """Return the source of a function or class, or the docstring of its module."""
    text = (ROOT / "src").joinpath(*module.split(".")).with_suffix(".py").read_text(encoding="utf-8")
    node = ast.parse(text)
    if name is None:
        return ast.get_docstring(node)
    for part in name.split("."):
        node = next(child for child in node.body if getattr(child, "name", None) == part)
    return ast.get_source_segment(text, node)


def test_the_index_names_every_equation_and_figure_of_the_model():
    tags = {row["tag"] for row in ROWS}
    assert {f"eq. ({number})" for number in range(1, 10)} <= tags
    assert {"Fig. 3", "Fig. 4", "Coulomb's law"} <= tags
    assert any("sin θ" in tag for tag in tags)
    assert len(ROWS) == PAGE.count("| `bladerub")


def test_every_function_of_the_index_bears_its_tag():
    for row in ROWS:
        source = source_of(row["module"], row["name"])
        # and not as the beginning of another
        assert re.search(re.escape(row["tag"]) + r"(?!\d)", source), row
