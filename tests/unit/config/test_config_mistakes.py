import copy
import math
import random
import re

import pytest
import yaml

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, read, validate
from bladerub.io.folders import ROOT
from tests.unit.config.mistakes import MISTAKES

STUDY = ROOT / "config" / "config.yaml"
WILD = [
    *(None, True, "", "x", "020", "1:30", "1,5", "../x", "ü\u202e", "~", "x" * 900, "5 mm", "-1 rpm", "3 %"),
    *("1e999999999 mm", math.nan, math.inf, -1, 0, 0.5, 1e-320, 1e308, 10**30, 10**400, 2**63),
    *([], {}, [[]], [None], [1] * 300, {"x": {"x": {}}}, {"": 0}, ["a", {"b": [1, 2]}], {"file": "x"}),
    *({"name": []}, {"table": 1}, {"coating": "rigid"}, {"friction": None}, {"[key]": 1}, {"layer": {}}),
]
RIGHT = ("must ", "unknown key", "not valid YAML", "there is no such file")


@pytest.mark.extras(cases=r"source\.file|contact\.law")
@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.key)
def test_a_mistake_is_named_with_file_line_key_and_what_is_right(tmp_path, problems, mistake):
    path = tmp_path / "my.yaml"
    path.write_text(mistake.text, encoding="utf-8")
    lines = map(str, problems(STUDY, path, by=read))
    (line,) = [line for line in lines if line.startswith(f"{path}:{mistake.line}: {mistake.key}")]
    assert mistake.right in line


def test_the_mistakes_of_all_parts_are_named_at_once(tmp_path, problems):
    (tmp_path / "my.yaml").write_text(
        "blade: {length: 9}\ncasings: {2nd: {weights: [0]}}\nfigures: {dpi: 2}\n"
    )
    found = problems(STUDY, tmp_path / "my.yaml", by=read)
    assert [problem.location.line for problem in found] == [1, 2, 3]


def groups(config):
    yield config
    for value in config.values() if isinstance(config, dict) else config:
        if value and isinstance(value, dict | list):
            yield from groups(value)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.nightly) for seed in (1, 2, 3))])
def test_a_hundred_wild_configs_are_valid_or_refused_in_lines(tmp_path, monkeypatch, seed):
    monkeypatch.chdir(ROOT)
    monkeypatch.setattr(yaml.SafeDumper, "ignore_aliases", lambda *_: True)
    path, study, chance, refused = tmp_path / "wild.yaml", load(STUDY), random.Random(seed), 0
    for _ in range(100):
        config = copy.deepcopy(study)
        for _ in range(chance.randint(1, 4)):
            group = chance.choice(list(groups(config)))
            if isinstance(group, dict):
                group[chance.choice([*group, "x", "file"])] = chance.choice(WILD)
            else:
                group[chance.randrange(len(group))] = chance.choice(WILD)
        path.write_text(yaml.safe_dump(config, allow_unicode=True), encoding="utf-8")
        try:
            read(path)
        except ConfigError as error:
            for line in map(str, error.problems):
                assert re.match(rf"{re.escape(str(path))}:[1-9]\d*: \S", line), line
                assert any(right in line for right in RIGHT), line
                assert len(line) < 1000
            refused += 1
    assert refused > 50


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
