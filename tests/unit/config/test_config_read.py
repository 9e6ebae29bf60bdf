from pathlib import Path

import pytest

from bladerub.config import record
from bladerub.config.errors import ConfigError
from bladerub.config.read import load, validate
from bladerub.config.record import Record
from bladerub.io.folders import ROOT

STUDY = ROOT / "config" / "config.yaml"


@pytest.mark.parametrize("over", [[], ["quick.yaml"], ["twisted_plate.yaml"]])
def test_configs_of_the_repository_are_valid(over):
    config = load(STUDY, *(STUDY.with_name(name) for name in over))
    assert validate(config).plain() == config


@pytest.mark.parametrize(
    ("entry", "start"),
    [
        ({"coating": "rigid", "friction": [0.0], "E": [2]}, "coatings[0].E = [2]: unknown key"),
        ({"coating": "rigid"}, "coatings[0].friction: missing"),
        ({"E": [3], "friction": [0.1]}, "coatings[0].K: missing"),
    ],
)
def test_each_kind_of_coating_has_keys_of_its_own(config, problems, entry, start):
    config["coatings"], config["analysis"]["histories"] = [entry | {"casing": "2nd"}], []
    assert [problem.text.startswith(start) for problem in problems(config)] == [True]


def test_the_mesh_counts_for_sections_and_not_for_a_mesh(config, problems, tmp_path):
    for name in ("blade.csv", "blade.msh"):
        (tmp_path / name).write_text("anything")
    config["blade"]["mesh"] = {"chordwise": 4, "thickness": 1, "spanwise": 2}
    config["blade"]["source"] = {"file": str(tmp_path / "blade.msh"), "root_set": "ROOT"}
    validate(config)
    config["blade"]["source"] = {"file": str(tmp_path / "blade.csv")}
    assert [problem.text.split(":")[0] for problem in problems(config)] == ["blade.mesh.chordwise = 4"]
    config["blade"]["mesh"] = {"chordwise": 200, "thickness": 20, "spanwise": 400}
    assert [problem.text.split(":")[0] for problem in problems(config)] == ["blade.mesh"]
    config["blade"]["source"]["root_set"] = "ROOT"
    assert [problem.text.split(":")[0] for problem in problems(config)] == ["blade.source.root_set = ROOT"]


def test_of_thousands_of_problems_forty_are_reported(config, problems):
    config["speeds"]["extra"] = [-1] * 9000
    found = problems(config)
    lines = str(ConfigError(found)).splitlines()
    assert (len(lines), lines[-1]) == (41, "config: and 8960 problems more")
    assert "more" not in str(ConfigError(found[:40]))


def test_what_was_laid_over_the_config_comes_back(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    files = [Path("config/config.yaml"), tmp_path / "config" / "quick.yaml", Path("/elsewhere/own.yaml")]
    record.write("results", files, {"results": "results"})
    found = record.read(tmp_path / "results")
    assert found == Record(["config/quick.yaml", "/elsewhere/own.yaml"], {"results": "results"})
    assert str(found) == "--config config/quick.yaml /elsewhere/own.yaml results=results"


@pytest.mark.parametrize("text", [None, "", "[1]", '{"files": 1}', '{"files": [], "command_line": [1]}'])
def test_nothing_was_laid_over_or_the_record_is_damaged(tmp_path, monkeypatch, text):
    monkeypatch.chdir(tmp_path)
    record.write("results", ["config/config.yaml"], {})
    if text is not None:
        (tmp_path / "results" / record.FILE).write_text(text)
    assert record.read(tmp_path / "results") is None
