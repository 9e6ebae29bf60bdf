import re

import pytest

from bladerub.extras.cost.forecast import forecast
from bladerub.extras.job_times import (
    GROWING,
    SECONDS_AT_FIRST,
    SECONDS_PER_JOB,
    SECONDS_PER_REVOLUTION,
)
from bladerub.study import inventory
from bladerub.workflow.cores import costs_of


@pytest.fixture
def study(config, monkeypatch):
    """A study of which so many runs of each coating are done."""

    def of(done):
        def take(config, plan, folder, digest):
            return dict.fromkeys(inventory.COUNTS, 0) | {"planned": 100, "done": done}, []

        monkeypatch.setattr(inventory, "take", take)
        monkeypatch.setattr(inventory, "current_blade", lambda *_: (None, None))
        return config | {"coatings": [{"casing": "2nd", "E": [1, 2], "K": [0.5], "theta": [0.0]}]}

    return of


JOBS = [(rule, f"2nd_E{E}_K0.5_theta0") for E in (1, 2) for rule in ("coating", "map", "ensemble")]


def test_a_dry_run_counts_what_is_left_and_what_its_jobs_cost(study):
    config = study(done=40)
    config["solver"]["revolutions"] = 3600
    jobs = [("blade", None), *JOBS, ("fig11_Y4", None)]
    costs = costs_of(config)
    runs = 0.6 * sum(costs.runs.values()) + sum(costs.further["ensemble"].values())
    longer = GROWING * config["analysis"]["divergence"]["confirmation_revolutions"]
    seconds = (
        runs * (3600 + longer) * SECONDS_PER_REVOLUTION + 8 * SECONDS_PER_JOB + SECONDS_AT_FIRST["blade"]
    )
    numbers = re.findall(r"\d+", forecast(config, jobs).replace(",", ""))
    assert numbers == ["120", "200", "8", f"{seconds / 60:.0f}"]
    assert costs.further["ensemble"][JOBS[0][1]] > 0


def test_runs_that_no_job_computes_are_not_announced(study):
    config = study(done=40)
    assert "120 of 200 runs of the study are to be computed; 6 jobs" in forecast(config, JOBS)
    assert "120 of 200 runs of the study are missing, and not asked for; 1 jobs" in forecast(
        config, [("chart_column", None)]
    )
