import re

import pytest

from bladerub.study import inventory
from bladerub.workflow.forecast import SECONDS_PER_REVOLUTION, forecast


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


def test_a_dry_run_counts_what_is_left_and_what_it_costs(study):
    config = study(done=40)
    config["solver"]["revolutions"] = 3600
    minutes = 120 * 3600 * SECONDS_PER_REVOLUTION / 60
    assert re.findall(r"\d+", forecast(config)) == ["120", "200", f"{minutes:.0f}"]


def test_a_dry_run_of_a_finished_study_says_so(study):
    assert "200" in forecast(study(done=100))
    assert "min" not in forecast(study(done=100))
