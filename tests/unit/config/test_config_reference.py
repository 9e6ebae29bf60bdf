from pathlib import Path

import pytest

from bladerub.config.read import load
from bladerub.config.reference import reference
from bladerub.config.schema import schema

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def text():
    return reference(schema(), load(ROOT / "config" / "config.yaml"))


def test_the_committed_one_is_up_to_date(text):
    assert (ROOT / "docs" / "config.md").read_text(encoding="utf-8") == text


def row(text, path):
    (line,) = [line for line in text.splitlines() if line.startswith(f"| `{path}` |")]
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_a_row_has_unit_range_value_and_reason(text):
    _, title, unit, may_be, value, why = row(text, "contact.damping_ratio")
    assert (title, unit, may_be, value) == (
        "modal damping ratio",
        "",
        "a number of at least 0 and below 1",
        "`0.0023`",
    )
    assert "titanium" in why
    assert row(text, "solver.revolutions")[3:5] == ["a whole number from 1 to 10000", "`20`"]
    assert row(text, "solver.scheme")[3] == "exponential or central_differences"


def test_names_lists_and_kinds_of_entries_have_rows(text):
    assert row(text, "casings.<name>.interference")[2] == "m"
    assert row(text, "speeds.extra[]")[1] == "speed"
    assert row(text, "coatings[].E[]")[1] == "Young modulus"
    assert row(text, "coatings[].friction[]")[1] == "coefficient of friction"


def test_every_key_of_the_study_has_a_row(text):
    def scalars(path, value):
        if isinstance(value, dict) and path != "casings":
            for name, inner in value.items():
                yield from scalars(f"{path}.{name}" if path else name, inner)
        elif not isinstance(value, dict | list):
            yield path

    for path in scalars("", load(ROOT / "config" / "config.yaml")):
        assert row(text, path)[4] != "", path
