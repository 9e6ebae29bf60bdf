"""What is made from the models of a config: the JSON schema and the reference."""

import jsonschema
import pytest
import yaml

from bladerub.cli import main
from bladerub.config.files import read
from bladerub.config.read import load
from bladerub.extras.config import json_schema
from bladerub.io.folders import ROOT
from docs.config_keys import reference
from docs.signatures import PAGE, updated
from tests.unit.config.mistakes import MISTAKES

CONFIGS = sorted(
    path
    for path in (ROOT / "config").glob("*.yaml")
    if path.read_text(encoding="utf-8").startswith("# yaml-language-server: $schema=schema.json\n")
)


STUDY = load(ROOT / "config" / "config.yaml")


@pytest.fixture(scope="module")
def schema():
    schema = json_schema.json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def test_the_committed_schema_and_reference_are_up_to_date():
    assert (ROOT / "config" / "schema.json").read_text(encoding="utf-8") == json_schema.text()
    assert (ROOT / "docs" / "config.md").read_text(encoding="utf-8") == reference(STUDY)


def test_the_schema_is_printed(capsys):
    assert main(["config", "--schema"]) == 0
    assert capsys.readouterr().out == json_schema.text()


@pytest.mark.parametrize("path", CONFIGS, ids=lambda path: path.stem)
def test_the_schema_allows_every_config(schema, path):
    assert len(CONFIGS) == 9
    schema.validate(read(path).plain())


def test_the_schema_allows_the_whole_study_and_units(schema):
    schema.validate(STUDY)
    schema.validate(yaml.safe_load("speeds: {start: 2000 rpm}\ncontact: {layer_thickness: 6 mm}"))


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.key)
def test_the_schema_refuses_the_mistakes_that_it_can_see(schema, tmp_path, mistake):
    path = tmp_path / "my.yaml"
    path.write_text(mistake.text, encoding="utf-8")
    assert schema.is_valid(read(path).plain()) != mistake.in_schema


def row(path):
    (line,) = [line for line in reference(STUDY).splitlines() if line.startswith(f"| `{path}` |")]
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_a_row_of_the_reference_has_unit_range_and_value():
    _, what, unit, may_be, value = row("contact.damping_ratio")
    assert "titanium" in what
    assert (unit, may_be, value) == ("", "a number of at least 0 and below 1", "`0.0023`")
    assert row("casings.<name>.interference")[2] == "m"
    assert "each a number above 0" in row("coatings[].E")[3]
    assert row("chart.speeds.step")[4] == "`0.008`"


def test_the_page_has_the_signatures_of_today():
    text = PAGE.read_text(encoding="utf-8")
    assert updated(text) == text
