import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.extras.small_study import SmallStudy
from bladerub.extras.variations import job
from bladerub.extras.variations.factors import Factor
from bladerub.extras.variations.plan import Job, Part, Plan

CONE = Factor("cone", "degrees", {"blade.tip_cone": (11.0, 15.0)}, multiple_of=1.0)


def part(name, claim):
    return Part(name, (Located.of({}, UNKNOWN),), (claim,))


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

    monkeypatch.setattr(job, "build", lambda config: config["blade"]["tip_cone"])
    monkeypatch.setattr(job, "write", write)
    monkeypatch.setattr(job, "conduct", conduct)
    monkeypatch.setattr(job, "measure", lambda evidence, claims: {f"of_{claim}": 1.0 for claim in claims})
    return cones


def test_each_set_has_verdicts_measures_and_cost_and_equal_blades_are_built_once(built, config, tmp_path):
    parts = part("soft", "C4"), part("stiff", "C12")
    plan = Plan({each.name: each for each in parts}, (CONE,))
    positions = {7: np.array([0.0]), 8: np.array([1.0]), 9: np.array([0.9])}
    found = job.judge(job.cases(config, plan, Job(range(7, 11), parts), positions), tmp_path)
    assert list(found.verdicts.columns) == job.VERDICTS
    assert list(found.verdicts["set"]) == [7, 7, 8, 8, 9, 9]
    assert list(found.verdicts.margin) == [11, 11, 15, 15, 15, 15]
    assert found.quantities.to_numpy().tolist()[:2] == [[7, "of_C4", 1.0], [7, "of_C12", 1.0]]
    assert list(found.cost.columns) == job.COST
    assert found.cost[["part", "set", "runs"]].to_numpy().tolist()[:3] == [
        ["soft", 7, 11],
        ["stiff", 7, 11],
        ["soft", 8, 15],
    ]
    assert np.isfinite(found.cost.cpu_s).all()
    assert built == [11, 15]  # two of the three sets round to the same cone
