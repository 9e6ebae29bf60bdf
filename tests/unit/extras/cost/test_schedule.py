"""The simulated schedule of a study."""

import pandas as pd
import pytest

from bladerub.config import read as configuration
from bladerub.extras.cost import schedule
from bladerub.study.grid import coating_cases

STUDY = {
    "coatings": [{"casing": "2nd", "E": [0.5, 1, 1.5, 2], "K": [0.5], "theta": [0.15]}],
    "speeds": {"start": 0.1, "stop": 0.4, "step": 0.1, "extra": []},
    "analysis": {"histories": []},
    "ensemble": {"members": 0},
}


@pytest.fixture(scope="module")
def study():
    return configuration.read("config/config.yaml", command_line=STUDY)


@pytest.fixture
def costs(study):
    """A blade in 60 s, four coatings of 300 s each with ensembles of 60 s, two tables of 30 s."""
    jobs = [("blade", "", 60.0), ("tables", "a", 30.0), ("tables", "b", 30.0)]
    for case in coating_cases(study):
        jobs += [("rubs", case.name, 300.0), ("ensembles", case.name, 60.0)]
    return pd.DataFrame(jobs, columns=["stage", "job", "wall_s"])


def minutes(costs, study, cores):
    return schedule.table(costs, study, [cores]).minutes[0]


def test_one_core_takes_the_sum_of_all_jobs(costs, study):
    (row,) = schedule.table(costs, study, [1]).itertuples()
    assert row.minutes == pytest.approx(costs.wall_s.sum() / 60)
    assert row.efficiency == pytest.approx(1.0)


def test_the_runs_of_the_longest_chain_come_first(costs, study, monkeypatch):
    """Else the last coating, here of the longest runs, would end long after the other core."""
    monkeypatch.setattr(schedule, "threads_for", lambda cost, total, cores: 1)
    last = coating_cases(study)[-1].name
    monkeypatch.setattr(schedule, "priority_of", lambda coating, expected: 0.5 * (coating == last))
    costs.loc[(costs.stage == "rubs") & (costs.job == last), "wall_s"] = 1020.0
    assert minutes(costs, study, 2) == pytest.approx(1 + (17 + 1) + 0.5)
