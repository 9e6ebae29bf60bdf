"""History matching over what the paper leaves open, by the real workflow: complete, and restartable."""

import re

import pytest
import yaml

from bladerub.io import tables

ALONE = {"ensemble": {"members": 0}, "analysis": {"histories": []}}
ANGLE = {"coatings": [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]}], **ALONE}
PLAN = {
    "seed": 1,
    "factors": {
        "unit": {"unit": "Pa", "scale": "log", "sets": {"contact.modulus_unit": [2.0e8, 9.0e8]}},
        "tip_turns": {"unit": "1", "multiple_of": 1, "sets": {"contact.tip_turns": [0, 1]}},
    },
    "parts": {"angle": {"claims": ["C10"], "study": ANGLE}},
    "sets": {"soft": {"unit": 3.0e8}},
    "waves": [14, 4],  # with the study's own and the given set as few as there may be
    "remaining": 0.01,
    "candidates": {"number": 1, "neighbours": 1, "shift": 0.02, "study": ANGLE},
}
PATH = "config/identification.yaml"


@pytest.fixture
def planned(copied_study, tiny):
    (copied_study.folder / PATH).write_text(yaml.safe_dump(PLAN, sort_keys=False))
    return tiny


def test_the_waves_are_planned(copied_study, planned):
    assert copied_study.plan(planned, "identify") == {
        "identification_kernel": 1,
        "identification_wave": 2,
        "identification_batch": 5,
        "identification_left": 2,
        "identification_candidates": 1,
        "identification_candidate": 4,
        "identify": 1,
    }


@pytest.mark.nightly
def test_waves_follow_one_another_and_a_lost_job_is_made_anew_alone(copied_study, planned):
    copied_study.build(planned, "identify")
    made = {
        path.stem.removeprefix("identification_"): tables.read(path)
        for path in (copied_study.results / "tables").glob("identification_*.csv")
    }
    sets = made["sets"].pivot(index="set", columns="factor", values="value")
    assert len(sets) == 20
    assert sets.unit[0] == pytest.approx(6.0e8)  # the study's own
    assert sets.unit[1] == pytest.approx(3.0e8)
    assert set(sets.tip_turns) == {0, 1}
    assert list(made["waves"].sets) == [16, 20]
    assert (made["waves"].remaining >= PLAN["remaining"]).all()
    targets = made["targets"].set_index("target")
    assert set(targets["id"]) == {"C10a", "C10b", "C10c", "C10d"}
    assert (targets.lowest <= targets.own_value).all()
    assert made["emulators"].within_two.between(0, 1).all()
    assert list(made["counts"].candidate) == [0, 0, 1, 1]
    assert (made["counts"].parts >= made["counts"].yes).all()
    assert made["counts"].parts.nunique() == 1  # of all claims that the study can judge
    assert set(made["ranges"].factor) == set(PLAN["factors"])
    assert (copied_study.results / "figures" / "identification.png").stat().st_size > 10_000
    assert copied_study.plan(planned, "identify") == {}

    lost = copied_study.results / "identification" / "wave2" / "0" / "quantities.csv"
    said = lost.read_bytes()
    lost.unlink()
    (copied_study.results / "tables" / "identification_counts.csv").unlink()
    assert copied_study.plan(planned, "identify")["identification_batch"] == 1
    copied_study.build(planned, "identify")
    assert lost.read_bytes() == said


def test_a_bad_plan_is_refused_before_any_work(workspace, tiny):
    (workspace.folder / PATH).write_text(yaml.safe_dump(PLAN | {"waves": [8, 4]}, sort_keys=False))
    done = workspace.snakemake("identify", "--dry-run", config=tiny)
    assert done.returncode == 2
    assert re.search(rf"{PATH}:\d+: waves = \[8, 4\]: the first must be at least 14", done.stderr)
    assert not workspace.results.exists()
    assert workspace.plan(tiny)["blade"] == 1  # a study needs no plan
