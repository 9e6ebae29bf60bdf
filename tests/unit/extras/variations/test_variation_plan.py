import copy
import dataclasses
import functools
import itertools
import operator
import re

import numpy as np
import pandas as pd
import pytest
import yaml
from study_fixtures import changed

from bladerub.config.errors import UNKNOWN, ConfigError
from bladerub.config.files import Located
from bladerub.extras.small_study import SmallStudy
from bladerub.extras.variations import job
from bladerub.extras.variations.job import cases, check, determinants
from bladerub.extras.variations.plan import REFERENCE, Job, Part, Plan, read
from bladerub.extras.variations.settings import Factor
from bladerub.extras.variations.waves import design
from bladerub.io.folders import ROOT

PLAN = {
    "seed": 3,
    "factors": {
        "unit": {"unit": "Pa", "scale": "log", "sets": {"contact.modulus_unit": [1.0e8, 1.0e10]}},
        "weight": {
            "unit": "1",
            "sets": {"casings.2nd5nd.weights[0]": [0.0, 1.0], "casings.2nd.amplitude": [2e-3, 4e-3]},
        },
        "turns": {"unit": "1", "sets": {"solver.revolutions": [12, 30]}, "multiple_of": 1},
    },
    "parts": {
        "soft": {"claims": ["C4"], "samples": 16, "study": {"speeds": {"start": 0.1}}},
        "stiff": {"claims": ["C12"], "samples": 4, "study": {}},
    },
}


def configs_of(study, plan, *jobs):
    of_jobs = [cases(study, plan, plan.jobs()[job]) for job in jobs]
    return {case.set: case.config.plain() for case in itertools.chain(*of_jobs)}


@pytest.fixture
def make(tmp_path):
    def made(plan):
        (tmp_path / "plan.yaml").write_text(yaml.safe_dump(plan, sort_keys=False))
        return read("robustness", tmp_path / "plan.yaml")

    return made


def test_a_sample_sets_every_number_of_its_factors(config, make):
    plan = make(PLAN)
    check(config, plan)
    configs = configs_of(config, plan, "soft/0", "soft/1")
    positions = design(plan)
    assert sorted(configs) == [*range(16)]
    for number, (unit, weight, turns) in enumerate(positions):
        varied = configs[number]
        assert varied["contact"]["modulus_unit"] == pytest.approx(1e8 * 100**unit)
        assert varied["casings"]["2nd5nd"]["weights"] == pytest.approx([weight, 1.0])
        assert varied["casings"]["2nd"]["amplitude"] == pytest.approx(2e-3 + 2e-3 * weight)
        assert varied["solver"]["revolutions"] == round(12 + 18 * turns)
        assert isinstance(varied["solver"]["revolutions"], int)
        assert varied["speeds"]["start"] == 0.1
    assert config.casings["2nd5nd"].weights == [0.25, 1.0]
    for column in positions.T:  # a Sobol sequence of 16 has one sample in each sixteenth of each factor
        assert sorted((16 * column).astype(int)) == list(range(16))
    assert list(plan.jobs()) == ["soft/reference", "soft/0", "soft/1", "stiff/reference", "stiff/0"]
    assert list(configs_of(config, plan, "soft/1")) == list(range(8, 16))
    own = configs_of(config, plan, "soft/reference")
    assert own.keys() == {REFERENCE}
    assert own[REFERENCE]["contact"] == config.plain()["contact"]
    assert own[REFERENCE]["speeds"]["start"] == 0.1


def edited(*keys, to):
    plan = copy.deepcopy(PLAN)
    functools.reduce(operator.getitem, keys[:-1], plan)[keys[-1]] = to
    return plan


UNIT, WEIGHT, TURNS = (("factors", name) for name in ("unit", "weight", "turns"))
MODULUS = "contact.modulus_unit"


def test_a_wrong_entry_of_a_plan_or_a_factor_of_no_number_is_refused_with_its_place(make, config):
    for plan, key in (
        (edited("seed", to=1.5), "seed = 1.5"),
        (edited(*UNIT, "sets", to={MODULUS: [1, 1]}), f'factors.unit.sets["{MODULUS}"][1] = 1'),
        (edited(*UNIT, "sets", to={MODULUS: [0, 1]}), f"factors.unit.sets.{MODULUS}"),
        (edited(*TURNS, "multiple_of", to=7), "factors.turns.sets.solver.revolutions"),
        (edited(*WEIGHT, "sets", MODULUS, to=[1, 2]), f"factors.weight.sets.{MODULUS}"),
        (edited("parts", "soft", "samples", to=12), "parts.soft.samples = 12"),
        (edited("parts", "soft", "claims", to=["C13"]), "parts.soft.claims[0]"),
        (edited("parts", "soft", "claims", to=["C12"]), "parts.stiff.claims"),
    ):
        with pytest.raises(ConfigError) as caught:
            make(plan)
        (problem,) = caught.value.problems
        assert problem.text.replace("'", '"').startswith(key)
        assert problem.location.source.endswith("plan.yaml")
        assert problem.location.line > 0
    for path in ("contact.modulus", "casings.2nd.weights[1]", "results"):
        plan = make(edited("factors", "unit", "sets", to={path: [1, 2]}))
        with pytest.raises(ConfigError, match=rf"plan.yaml:\d+: factors.unit.sets.{re.escape(path)}"):
            configs_of(config, plan, "soft/0")


def test_only_what_determines_a_sample_is_a_reason_to_run_it(config, make):
    plan = make(PLAN)
    job = plan.jobs()["soft/0"]
    before = determinants(config, plan, job)
    assert len({entry for *_, entry in before}) == 8
    elsewhere = {"figures": {"dpi": 90}, "chart": {"theta": [0.0]}}
    elsewhere["casings"] = {"unused": config.casings["2nd"].plain()}
    stiffer = config.replaced("contact.modulus_unit", 2 * config.contact.modulus_unit)  # set by a factor
    assert determinants(changed(stiffer, **elsewhere), plan, job) == before
    after = determinants(config.replaced("solver.tolerance", 1e-3), plan, job)
    assert not set(map(str, after)) & set(map(str, before))
    plan = read("identification", ROOT / "config" / "identification.yaml")
    job = plan.jobs()["wave1/3"]
    assert list(job.sets) == [12, 13, 14, 15]
    before = determinants(config, plan, job)
    assert list(plan.factors) == [entry[0] for entry in before[8:]]
    with pytest.raises(ConfigError, match=r"factors.damping.sets.* must hold the study's own value, 0.02"):
        plan.listed(config.replaced("contact.damping_ratio", 0.02))
    nowhere = plan.factors["damping"].model_copy(update={"sets": {"contact.none": [0, 1]}})
    with pytest.raises(ConfigError, match=r"factors.damping.sets.contact.none: must be a number"):
        dataclasses.replace(plan, factors={"damping": nowhere}).listed(config)
    after = determinants(stiffer, plan, job)
    assert not set(map(str, after[:8])) & set(map(str, before[:8]))


def sets_of(config):
    listed = read("calibration", config.calibration, "calibration")
    check(config, listed)
    jobs = listed.jobs().values()
    return {case.set: case.checked() for job in jobs for case in cases(config, listed, job)}


def test_each_set_is_laid_over_what_is_common_and_that_over_a_file(config, tmp_path):
    def asked(text):
        (tmp_path / "plan.yaml").write_text(text)
        return config.replaced("calibration", str(tmp_path / "plan.yaml"))

    text = "common: {speeds: {start: 0.1}, contact: {damping_ratio: 1.0e-3}}\nsets:\n  as_it_is: {}\n"
    text += "  stiff: {contact: {modulus_unit: 400.0e+6}}\n  loose: {contact: {damping_ratio: 5e-3}}\n"
    sets = sets_of(asked(text))
    assert list(sets) == ["as_it_is", "stiff", "loose"]
    assert [config.contact.damping_ratio for config in sets.values()] == [1e-3, 1e-3, 5e-3]
    assert sets["stiff"].contact.modulus_unit == 400e6
    assert sets["loose"].contact.modulus_unit == config.contact.modulus_unit
    assert config.speeds.start == 0.02
    (tmp_path / "soft.yaml").write_text("contact: {modulus_unit: 1.0e+8, damping_ratio: 1.0e-3}\n")
    text = "common: {contact: {damping_ratio: 2.0e-3}}\nsets: {a: {}, b: {contact: {modulus_unit: 4.0e+8}}}\n"
    sets = sets_of(asked(f"file: soft.yaml\n{text}"))
    assert [config.contact.modulus_unit for config in sets.values()] == [1e8, 4e8]
    assert {config.contact.damping_ratio for config in sets.values()} == {2e-3}
    with pytest.raises(ConfigError, match=r"plan.yaml:1: file = .*: cannot be read"):
        sets_of(asked(f"file: none.yaml\n{text}"))
    with pytest.raises(ConfigError, match=r"a: contact.damping_ratio = 2.*\n.* c: contact.damping"):
        sets_of(asked("sets: {a: {contact: {damping_ratio: 2}}, c: {contact: {damping: 1}}}\n"))


@pytest.mark.parametrize(("file", "of_the_study"), [("calibration", "study"), ("laws", "plastic")])
def test_the_plans_of_the_repository_have_the_study_in_them(config, file, of_the_study, monkeypatch):
    monkeypatch.chdir(ROOT)
    sets = sets_of(config.replaced("calibration", f"config/{file}.yaml"))
    own, given = sets[of_the_study].plain(), config.plain()
    assert all(own[part] == given[part] for part in ("blade", "contact", "casings", "solver"))


CONE = Factor(unit="degrees", sets={"blade.tip_cone": [11.0, 15.0]}, multiple_of=1.0)


def test_each_set_has_verdicts_measures_and_cost_and_equal_blades_are_built_once(
    config, tmp_path, monkeypatch
):
    built = []  # cones of the blades

    def write(cone, origin, model):
        built.append(cone)
        model.touch()

    def conduct(config, model, rom_accuracy, folder, claims, report):
        assert model.exists()
        table = pd.DataFrame({"id": list(claims), "holds": "yes", "margin": config.blade.tip_cone})
        runs = int(config.blade.tip_cone)
        return SmallStudy(pd.DataFrame(), pd.DataFrame(), table.reindex(columns=job.VERDICTS[1:]), runs, None)

    stand_ins = {"build": lambda config: config.blade.tip_cone, "write": write, "conduct": conduct}
    stand_ins["measure"] = lambda evidence, claims: {f"of_{claim}": 1.0 for claim in claims}
    for name, function in stand_ins.items():
        monkeypatch.setattr(job, name, function)
    empty = (Located.of({}, UNKNOWN),)
    parts = Part("soft", empty, ("C4",)), Part("stiff", empty, ("C12",))
    plan = Plan({each.name: each for each in parts}, {"cone": CONE})
    positions = {7: np.array([0.0]), 8: np.array([1.0]), 9: np.array([0.9])}
    found = job.judge(job.cases(config, plan, Job(range(7, 11), parts), positions), tmp_path)
    assert list(found["verdicts"]["set"]) == [7, 7, 8, 8, 9, 9]
    assert list(found["verdicts"].margin) == [11, 11, 15, 15, 15, 15]
    assert found["quantities"].to_numpy().tolist()[:2] == [[7, "of_C4", 1.0], [7, "of_C12", 1.0]]
    costs = found["cost"][["part", "set", "runs"]].to_numpy().tolist()
    assert costs[:3] == [["soft", 7, 11], ["stiff", 7, 11], ["soft", 8, 15]]
    assert built == [11, 15]  # two of the three sets round to the same cone
