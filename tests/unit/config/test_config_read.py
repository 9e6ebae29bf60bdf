import pytest

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, validate
from bladerub.io.folders import ROOT

STUDY = ROOT / "config" / "config.yaml"


@pytest.mark.extras(cases=r"over[12]")
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


@pytest.mark.extras
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
