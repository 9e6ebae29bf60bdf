import jsonschema
import pytest
import yaml

from bladerub.cli import main
from bladerub.config.files import read
from bladerub.config.read import load
from bladerub.extras.config import json_schema
from bladerub.io.folders import ROOT
from docs import config_keys, signatures
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


def test_the_committed_schema_and_pages_are_up_to_date(capsys):
    assert main(["config", "--schema"]) == 0
    assert (ROOT / "config" / "schema.json").read_text(encoding="utf-8") == capsys.readouterr().out
    page = config_keys.PAGE.read_text(encoding="utf-8")
    assert config_keys.updated(page, STUDY) == page
    page = signatures.PAGE.read_text(encoding="utf-8")
    assert signatures.updated(page) == page


def test_the_schema_allows_every_config_the_whole_study_and_units(schema):
    assert len(CONFIGS) == 9
    for path in CONFIGS:
        schema.validate(read(path).plain())
    schema.validate(STUDY)
    schema.validate(yaml.safe_load("speeds: {start: 2000 rpm}\ncontact: {layer_thickness: 6 mm}"))


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.key)
def test_the_schema_refuses_the_mistakes_that_it_can_see(schema, tmp_path, mistake):
    path = tmp_path / "my.yaml"
    path.write_text(mistake.text, encoding="utf-8")
    assert schema.is_valid(read(path).plain()) != mistake.in_schema
