import copy
import functools
import itertools
import operator

import pytest
import yaml

from bladerub.config.errors import ConfigError
from bladerub.config.read import validate
from bladerub.extras.variations.job import cases, check, determinants
from bladerub.extras.variations.plan import REFERENCE, read
from bladerub.extras.variations.waves import design, known
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
    """The config of each sample of some jobs, by number."""
    of_jobs = [cases(study, plan, plan.jobs()[job], known(plan)) for job in jobs]
    return {case.set: case.config.plain() for case in itertools.chain(*of_jobs)}


@pytest.fixture
def study(config):
    return validate(config)


@pytest.fixture
def make(tmp_path):
    """Read a plan from a file."""

    def made(plan):
        (tmp_path / "plan.yaml").write_text(yaml.safe_dump(plan, sort_keys=False))
        return read("robustness", tmp_path / "plan.yaml")

    return made


def test_a_sample_sets_every_number_of_its_factors(study, make):
    plan = make(PLAN)
    check(study, plan)
    configs = configs_of(study, plan, "soft/0", "soft/1")
    positions = design(plan)
    assert sorted(configs) == [*range(16)]
    for number, (unit, weight, turns) in enumerate(positions):
        config = configs[number]
        assert config["contact"]["modulus_unit"] == pytest.approx(1e8 * 100**unit)
        assert config["casings"]["2nd5nd"]["weights"] == pytest.approx([weight, 1.0])
        assert config["casings"]["2nd"]["amplitude"] == pytest.approx(2e-3 + 2e-3 * weight)
        assert config["solver"]["revolutions"] == round(12 + 18 * turns)
        assert isinstance(config["solver"]["revolutions"], int)
        assert config["speeds"]["start"] == 0.1
    assert study["casings"]["2nd5nd"]["weights"] == [0.25, 1.0]
    for column in positions.T:  # a Sobol sequence of 16 has one sample in each sixteenth of each factor
        assert sorted((16 * column).astype(int)) == list(range(16))


def changed(*keys, to):
    plan = copy.deepcopy(PLAN)
    functools.reduce(operator.getitem, keys[:-1], plan)[keys[-1]] = to
    return plan


UNIT, WEIGHT, TURNS = (("factors", name) for name in ("unit", "weight", "turns"))
MODULUS = "contact.modulus_unit"


@pytest.mark.parametrize(
    ("plan", "key"),
    [
        (changed("seed", to=1.5), "seed = 1.5"),
        (changed("sedd", to=1), "sedd"),
        (changed(*UNIT, "sets", to={MODULUS: [1, 1]}), f'factors.unit.sets["{MODULUS}"][1] = 1'),
        (changed(*UNIT, "sets", to={MODULUS: [0, 1]}), f"factors.unit.sets.{MODULUS}"),
        (changed(*TURNS, "multiple_of", to=7), "factors.turns.sets.solver.revolutions"),
        (changed(*WEIGHT, "sets", MODULUS, to=[1, 2]), f"factors.weight.sets.{MODULUS}"),
        (changed("parts", "soft", "samples", to=12), "parts.soft.samples = 12"),
        (changed("parts", "soft", "claims", to=["C13"]), "parts.soft.claims[0]"),
        (changed("parts", "soft", "claims", to=["C12"]), "parts.stiff.claims"),
    ],
)
def test_a_wrong_entry_of_a_plan_is_refused_with_its_place(make, plan, key):
    with pytest.raises(ConfigError) as caught:
        make(plan)
    (problem,) = caught.value.problems
    assert problem.text.replace("'", '"').startswith(key)
    assert problem.location.source.endswith("plan.yaml")
    assert problem.location.line > 0


@pytest.mark.parametrize(
    "path", ["contact.modulus", "casings.2nd.weights[1]", "casings.2nd.weights", "results"]
)
def test_a_factor_must_set_a_number_of_the_study(study, make, path):
    plan = make(changed("factors", "unit", "sets", to={path: [1, 2]}))
    with pytest.raises(ConfigError) as caught:
        configs_of(study, plan, "soft/0")
    (problem,) = caught.value.problems
    assert problem.text.startswith(f"factors.unit.sets.{path}")
    assert problem.location == plan.factors[0].location


def test_only_what_determines_a_sample_is_a_reason_to_run_it(study, make):
    plan = make(PLAN)
    job = plan.jobs()["soft/0"]
    before = determinants(study, plan, job)
    assert len({entry for *_, entry in before}) == 8
    study["figures"]["dpi"] += 1
    study["chart"]["theta"] = [0.0]
    study["casings"]["unused"] = study["casings"]["2nd"]
    study["contact"]["modulus_unit"] *= 2  # set by a factor
    assert determinants(study, plan, job) == before
    study["solver"]["tolerance"] /= 2
    assert not set(determinants(study, plan, job)) & set(before)


def test_sets_that_are_drawn_later_depend_on_the_study_and_the_factors(study):
    plan = read("identification", ROOT / "config" / "identification.yaml")
    job = plan.jobs()["wave1/3"]
    assert list(job.sets) == [12, 13, 14, 15]
    before = determinants(study, plan, job)
    assert [factor.name for factor in plan.factors] == [entry[0] for entry in before[8:]]
    study["contact"]["modulus_unit"] *= 2
    changed = determinants(study, plan, job)
    assert not set(map(str, changed[:8])) & set(map(str, before[:8]))


def test_jobs_have_their_samples_and_one_the_study_s_own_values(study, make):
    plan = make(PLAN)
    assert list(plan.jobs()) == ["soft/reference", "soft/0", "soft/1", "stiff/reference", "stiff/0"]
    assert list(configs_of(study, plan, "soft/1")) == list(range(8, 16))
    own = configs_of(study, plan, "soft/reference")
    assert own.keys() == {REFERENCE}
    assert own[REFERENCE]["contact"] == study["contact"]
    assert own[REFERENCE]["speeds"]["start"] == 0.1
