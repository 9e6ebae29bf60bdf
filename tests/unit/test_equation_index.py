"""Each line of docs/reference/equations.md names a function whose source bears the tag of that line."""

import ast
import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reference" / "equations.md"
ROW = re.compile(
    r"^\| `(?P<tag>.+?)` \|.*\| `(?P<module>bladerub[\w.]*)(?::(?P<name>[\w.]+))?`[^|]*\|$", re.M
)


class Line(NamedTuple):
    tag: str
    module: str
    name: str | None


LINES = [
    Line(row["tag"].replace(r"\|", "|"), row["module"], row["name"])
    for row in ROW.finditer(PAGE.read_text(encoding="utf-8"))
]
IDS = [f"{line.tag[:16]} {line.module}:{line.name}" for line in LINES]


@cache
def module_source(module):
    path = (ROOT / "src").joinpath(*module.split("."))
    return path.with_suffix(".py").read_text(encoding="utf-8")


def source_of(line, module_text):
    """Return the source of the function or class that a line names, or the docstring of its module."""
    node = ast.parse(module_text)
    if line.name is None:
        return ast.get_docstring(node)
    for part in line.name.split("."):
        node = next(child for child in node.body if getattr(child, "name", None) == part)
    return ast.get_source_segment(module_text, node)


def is_marked(line, module_text):
    """Whether the tag is in the source, and not as the beginning of another."""
    return re.search(re.escape(line.tag) + r"(?!\d)", source_of(line, module_text)) is not None


def test_the_index_names_every_equation_and_figure_of_the_model():
    tags = {line.tag for line in LINES}
    assert {f"eq. ({number})" for number in range(1, 10)} <= tags
    assert {"Fig. 3", "Fig. 4", "Coulomb's law"} <= tags
    assert any("sin θ" in tag for tag in tags)
    assert len(LINES) == PAGE.read_text(encoding="utf-8").count("| `bladerub")


@pytest.mark.parametrize("line", LINES, ids=IDS)
def test_every_function_of_the_index_bears_its_tag(line):
    assert is_marked(line, module_source(line.module))


@pytest.mark.parametrize("line", LINES, ids=IDS)
def test_a_tag_that_is_taken_away_is_missed(line):
    assert not is_marked(line, module_source(line.module).replace(line.tag, "it"))
