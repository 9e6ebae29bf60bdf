import pandas as pd
import pytest

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, validate
from bladerub.extras.calibration import COLUMNS, collect, counts, plan
from bladerub.io.folders import ROOT
from bladerub.study.findings import verdicts


@pytest.fixture
def study():
    return validate(load(ROOT / "config" / "config.yaml"))


@pytest.fixture
def asked(study, tmp_path):
    """The study with a plan of its own, from the text of it."""

    def asking(text):
        path = tmp_path / "plan.yaml"
        path.write_text(text)
        return study | {"calibration": str(path)}

    return asking


def test_each_set_is_laid_over_what_is_common(study, asked):
    config = asked(
        "common: {speeds: {start: 0.1}, contact: {damping_ratio: 1.0e-3}}\n"
        "sets:\n"
        "  as_it_is: {}\n"
        "  stiff: {contact: {modulus_unit: 400.0e+6}}\n"
        "  loose: {contact: {damping_ratio: 5e-3}}\n"
    )
    sets = plan(config)
    assert list(sets) == ["as_it_is", "stiff", "loose"]
    assert all(config["speeds"]["start"] == 0.1 for config in sets.values())
    assert [config["contact"]["damping_ratio"] for config in sets.values()] == [1e-3, 1e-3, 5e-3]
    assert sets["stiff"]["contact"]["modulus_unit"] == 400e6
    assert sets["loose"]["contact"]["modulus_unit"] == study["contact"]["modulus_unit"]
    assert study["speeds"]["start"] == 0.02


def test_every_problem_is_reported_with_its_set(study, asked):
    config = asked("sets: {a: {contact: {damping_ratio: 2}}, c: {contact: {damping: 1}}}\n")
    with pytest.raises(ConfigError) as caught:
        plan(config)
    first, second = sorted(problem.text for problem in caught.value.problems)
    assert first.startswith("a: contact.damping_ratio = 2")
    assert second.startswith("c: contact.damping")


def test_a_plan_what_is_common_and_a_set_can_extend_files(study, asked, tmp_path):
    (tmp_path / "deeper").mkdir()
    (tmp_path / "deeper" / "old.yaml").write_text("extend: finer.yaml\nsets: {old: {extend: finer.yaml}}\n")
    (tmp_path / "deeper" / "finer.yaml").write_text("common: {}\n")
    (tmp_path / "soft.yaml").write_text("contact: {modulus_unit: 1.0e+8, damping_ratio: 1.0e-3}\n")
    config = asked(
        "extend: deeper/old.yaml\n"
        "common: {extend: soft.yaml, speeds: {start: 0.1}}\n"
        "sets: {old: {}, stiff: {contact: {modulus_unit: 4.0e+8}}, again: {extend: [soft.yaml]}}\n"
    )
    with pytest.raises(ConfigError) as caught:  # a plan is no config, so that one cannot begin from it
        plan(config)
    assert "finer.yaml:1: old: common = {}: unknown key" in str(caught.value)
    (tmp_path / "deeper" / "old.yaml").write_text("extend: finer.yaml\nsets: {old: {}}\n")
    sets = plan(config)
    assert list(sets) == ["old", "stiff", "again"]
    assert [config["contact"]["modulus_unit"] for config in sets.values()] == [1e8, 4e8, 1e8]
    assert {config["contact"]["damping_ratio"] for config in sets.values()} == {1e-3}
    assert {config["speeds"]["start"] for config in sets.values()} == {0.1}


@pytest.mark.parametrize(("file", "of_the_study"), [("calibration", "study"), ("laws", "plastic")])
def test_the_plans_of_the_repository_have_the_study_in_them(study, file, of_the_study, monkeypatch):
    monkeypatch.chdir(ROOT)
    sets = plan(study | {"calibration": f"config/{file}.yaml"})
    own = sets[of_the_study]
    assert all(own[part] == study[part] for part in ("blade", "contact", "casings", "solver"))


def test_findings_of_all_sets_make_one_table(tmp_path):
    paths = {}
    for name, holds in (("b", ["yes", "no"]), ("a", ["partly"])):
        rows = [
            {
                "id": f"C{i}",
                "claim": "c",
                "paper": 1,
                "measured": 2,
                "unit": "1",
                "holds": each,
                "margin": 0.5,
                "measured_by_harmonic": "",
                "holds_by_harmonic": "",
            }
            for i, each in enumerate(holds)
        ]
        paths[name] = tmp_path / f"{name}.csv"
        pd.DataFrame(rows).to_csv(paths[name], index=False)
    table = collect(paths)
    assert list(table.columns) == COLUMNS
    wide = verdicts(table, by="set")
    assert list(wide.columns) == ["b", "a"]
    assert list(wide.loc["C0"]) == ["yes", "partly"]
    assert wide.loc["C1", "b"] == "no"
    assert pd.isna(wide.loc["C1", "a"])


def test_verdicts_are_counted_and_compared_with_the_first_set():
    verdicts = {
        "study": {"C1a": "yes", "C2a": "partly", "C4a": "no"},
        "soft": {"C1a": "no", "C2a": "yes", "C4a": "no", "C5a": "yes"},
        "stiff": {"C1a": "partly", "C2a": "no"},
    }
    rows = [(name, id_, holds) for name, own in verdicts.items() for id_, holds in own.items()]
    table = counts(pd.DataFrame(rows, columns=["set", "id", "holds"]))
    assert table.values.tolist() == [
        ["study", 1, 1, 1, "", ""],
        ["soft", 2, 0, 2, "C2a", "C1a"],
        ["stiff", 0, 1, 1, "", "C1a C2a"],
    ]
