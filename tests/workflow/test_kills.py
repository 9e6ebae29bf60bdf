"""Real kills of the real workflow; `kills.py` does it on a larger study, as often as asked."""

import itertools

import kills
import pytest
import yaml


@pytest.fixture
def killed(study, tiny, tmp_path):
    """The tiny study without its results, to be made up to its peaks."""
    workspace = study.copy(tmp_path / "killed", "results", ".snakemake")
    (workspace.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
    return kills.Study(workspace, ("-j2", "results/tables/peaks.csv", "--configfile", "overlay.yaml"))


def test_kills_cost_nothing_but_what_they_interrupt(study, killed):
    def compare():
        assert kills.unlike(killed.workspace, study) == []

    seconds = 15.0  # about what it takes; a kill that comes too late is made up for
    done = list(itertools.islice(kills.torment(killed, compare, seconds, seed=3), 3))
    assert [kill.way for kill in done] == list(kills.WAYS)
    kills.finish(killed)
    compare()
