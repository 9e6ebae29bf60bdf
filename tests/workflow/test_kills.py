"""Real kills of the real workflow; `kills.py` does it on a larger study, as often as asked."""

import itertools

import kills
import pytest
import yaml

ROWS = {
    "casing": "2nd",
    "E": 2,
    "K": 0.5,
    "theta": 0.0,
    "f_omega": [0.19, 0.28],
    "blades": [4],
    "length_scatter": [5.0e-5],
    "frequency_scatter": [0.01],
    "coupling": [0, 0.01],
    "draws": 30,
}


@pytest.fixture
def killed(study, tiny, tmp_path):
    """The tiny study without its results, to be made up to its peaks."""
    workspace = study.copy(tmp_path / "killed", "results", ".snakemake")
    (workspace.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
    return kills.Study(workspace, ("-j2", "results/tables/peaks.csv", "--configfile", "overlay.yaml"))


def test_kills_cost_nothing_but_what_they_interrupt(study, killed):
    def compare():
        assert kills.unlike(killed.workspace, study) == []

    _torment(killed, compare, seconds=15.0, seed=3)


def test_kills_of_jobs_with_rows_of_blades_cost_nothing_but_what_they_interrupt(study, tiny, tmp_path):
    def make(name):
        workspace = study.copy(tmp_path / name)
        plan = yaml.safe_dump({"seed": 1, "groups": {"some": ROWS}}, sort_keys=False)
        (workspace.folder / "config" / "rotor.yaml").write_text(plan)
        (workspace.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
        return kills.Study(workspace, ("-j2", "rotor", "--configfile", "overlay.yaml"))

    undisturbed, killed = make("undisturbed"), make("killed")
    kills.finish(undisturbed)

    def compare():
        assert kills.unlike(killed.workspace, undisturbed.workspace) == []

    _torment(killed, compare, seconds=10.0, seed=5)


def _torment(killed, compare, seconds, seed):
    # seconds: about what it takes; a kill that comes too late is made up for
    done = list(itertools.islice(kills.torment(killed, compare, seconds, seed), len(kills.WAYS)))
    assert [kill.way for kill in done] == list(kills.WAYS)
    kills.finish(killed)
    compare()
