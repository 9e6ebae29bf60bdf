import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import UNKNOWN, ConfigError
from bladerub.config.files import Located
from bladerub.config.read import validate
from bladerub.extras.small_study import SmallStudy
from bladerub.extras.variations import job
from bladerub.extras.variations.factors import Factor
from bladerub.extras.variations.job import cases, check
from bladerub.extras.variations.plan import Job, Part, Plan, read
from bladerub.extras.variations.waves import known
from bladerub.io.folders import ROOT


@pytest.fixture
def study(config):
    return validate(config)


def plan(config):
    """The config of each set by name, all of them checked."""
    listed = read("calibration", config["calibration"], "calibration")
    check(config, listed)
    jobs = listed.jobs().values()
    return {case.set: case.checked() for job in jobs for case in cases(config, listed, job, known(listed))}


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


def test_a_plan_can_name_a_file_that_lies_under_what_is_common(asked, tmp_path):
    (tmp_path / "soft.yaml").write_text("contact: {modulus_unit: 1.0e+8, damping_ratio: 1.0e-3}\n")
    text = "common: {contact: {damping_ratio: 2.0e-3}}\n"
    text += "sets: {old: {}, stiff: {contact: {modulus_unit: 4.0e+8}}}\n"
    sets = plan(asked(f"file: soft.yaml\n{text}"))
    assert [config["contact"]["modulus_unit"] for config in sets.values()] == [1e8, 4e8]
    assert {config["contact"]["damping_ratio"] for config in sets.values()} == {2e-3}
    with pytest.raises(ConfigError, match=r"plan.yaml:1: file = .*: cannot be read"):
        plan(asked(f"file: none.yaml\n{text}"))


@pytest.mark.parametrize(("file", "of_the_study"), [("calibration", "study"), ("laws", "plastic")])
def test_the_plans_of_the_repository_have_the_study_in_them(study, file, of_the_study, monkeypatch):
    monkeypatch.chdir(ROOT)
    sets = plan(study | {"calibration": f"config/{file}.yaml"})
    own = sets[of_the_study]
    assert all(own[part] == study[part] for part in ("blade", "contact", "casings", "solver"))


CONE = Factor("cone", "degrees", {"blade.tip_cone": (11.0, 15.0)}, multiple_of=1.0)


@pytest.fixture
def built(monkeypatch):
    """Small studies that are not simulated; the cones of the blades that had to be built."""
    cones = []

    def write(cone, origin, model, mesh, rom_accuracy):
        cones.append(cone)
        model.touch()

    def conduct(config, model, rom_accuracy, folder, claims, report):
        assert model.exists()
        table = pd.DataFrame({"id": list(claims), "holds": "yes", "margin": config["blade"]["tip_cone"]})
        runs = int(config["blade"]["tip_cone"])
        return SmallStudy(pd.DataFrame(), pd.DataFrame(), table.reindex(columns=job.VERDICTS[1:]), runs, None)

    stand_ins = {"build": lambda config: config["blade"]["tip_cone"], "write": write, "conduct": conduct}
    stand_ins["measure"] = lambda evidence, claims: {f"of_{claim}": 1.0 for claim in claims}
    for name, function in stand_ins.items():
        monkeypatch.setattr(job, name, function)
    return cones


def test_each_set_has_verdicts_measures_and_cost_and_equal_blades_are_built_once(built, config, tmp_path):
    empty = (Located.of({}, UNKNOWN),)
    parts = Part("soft", empty, ("C4",)), Part("stiff", empty, ("C12",))
    plan = Plan({each.name: each for each in parts}, (CONE,))
    positions = {7: np.array([0.0]), 8: np.array([1.0]), 9: np.array([0.9])}
    found = job.judge(job.cases(config, plan, Job(range(7, 11), parts), positions), tmp_path)
    assert list(found.verdicts["set"]) == [7, 7, 8, 8, 9, 9]
    assert list(found.verdicts.margin) == [11, 11, 15, 15, 15, 15]
    assert found.quantities.to_numpy().tolist()[:2] == [[7, "of_C4", 1.0], [7, "of_C12", 1.0]]
    assert [list(found.verdicts.columns), list(found.cost.columns)] == [job.VERDICTS, job.COST]
    costs = found.cost[["part", "set", "runs"]].to_numpy().tolist()
    assert costs[:3] == [["soft", 7, 11], ["stiff", 7, 11], ["soft", 8, 15]]
    assert built == [11, 15]  # two of the three sets round to the same cone
