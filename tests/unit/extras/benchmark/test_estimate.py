"""The estimate of the study's time."""

import pytest

from bladerub.config import read as configuration
from bladerub.extras.benchmark import estimate as module
from bladerub.extras.benchmark.estimate import _Cost, estimate
from bladerub.extras.study_runs import study_runs

SMALL = {
    "coatings": [{"casing": "2nd", "E": [2, 20], "K": [0.5], "theta": [0.15]}],
    "speeds": {"start": 0.16, "stop": 0.4, "step": 0.06, "extra": []},
    "solver": {"revolutions": 3},
    "ensemble": {"members": 2},
    "analysis": {
        "spectrum_revolutions": 2,
        "divergence": {"revolutions": 3, "confirmation_revolutions": 6},
        "histories": [{"casing": "2nd", "E": 2, "K": 0.5, "theta": 0.15, "f_omega": 0.16}],
    },
}


@pytest.fixture(scope="module")
def study():
    return configuration.read("config/config.yaml", command_line=SMALL)


def test_runs_and_members_cost_what_the_drawn_ones_do(study, blade, monkeypatch):
    """Runs at 0.16 grow and are near a peak, others take twice as long."""

    def cost(blade, config, folder, run):
        near = run.f_omega == 0.16
        return _Cost(1.0, 3.0, True) if near else _Cost(2.0, 0.0, False)

    monkeypatch.setattr(module, "_cost", cost)
    monkeypatch.setattr(module, "_start", lambda imported: 0.5)
    found = estimate(blade, study, cores=4, drawn=1000)
    runs = len(study_runs(study))
    near, members = 2, (2 + 2) * (1 + 3 * 2 + 3 * 2)  # and refined: histories, each peak with its neighbours
    seconds = near * 4.0 + (runs - near) * 2.0 + members * 4.0 + 2 * 3 * 0.5
    assert found["study_minutes"] == pytest.approx(seconds / 4 / 60)
    assert found["seconds_per_run"] == pytest.approx((near * 1.0 + (runs - near) * 2.0) / runs)
    assert (found["runs"], found["members"], found["cores"]) == (runs, members, 4)
