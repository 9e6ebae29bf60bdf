"""Plans that vary what the paper leaves open, by the real workflow: complete, and restartable."""

import re

import pytest
import yaml

from bladerub.io import tables

ALONE = {"ensemble": {"members": 0}, "analysis": {"histories": []}}
LOBES = {"coatings": [{"casing": "2nd5nd", "E": [11], "K": [0.5], "theta": [0.0]}], **ALONE}
ANGLE = {"coatings": [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]}], **ALONE}
ROBUSTNESS = {
    "seed": 1,
    "factors": {
        "unit": {"unit": "Pa", "scale": "log", "sets": {"contact.modulus_unit": [2.0e8, 8.0e8]}},
        "lean": {"unit": "degrees", "sets": {"blade.tip_cone": [12.0, 13.0]}, "multiple_of": 1},
        "step": {"unit": "1", "sets": {"speeds.step": [0.03, 0.05]}, "multiple_of": 0.005},
    },
    "parts": {
        "lobes": {"claims": ["C1", "C3"], "samples": 16, "study": LOBES},
        "angle": {"claims": ["C10"], "samples": 2, "study": ANGLE},
    },
}
IDENTIFICATION = {
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


def write(workspace, name, plan):
    (workspace.folder / "config" / f"{name}.yaml").write_text(yaml.safe_dump(plan, sort_keys=False))


@pytest.fixture
def planned(copied_study):
    write(copied_study, "robustness", ROBUSTNESS)
    write(copied_study, "identification", IDENTIFICATION)
    return copied_study


def read(workspace, name):
    return tables.read(workspace.results / "tables" / f"{name}.csv")


def test_jobs_are_planned(planned, tiny):
    assert planned.plan(tiny, "robustness") == {"variation": 5, "robustness": 1}
    assert planned.plan(tiny, "identify") == {
        "identification_wave": 2,
        "variation": 5 + 4,  # of the sets, and of candidates and neighbours
        "identification_left": 2,
        "identification_candidates": 1,
        "identify": 1,
    }


@pytest.mark.nightly
def test_the_design_is_made_once_and_a_lost_job_is_made_anew_alone(planned, tiny):
    planned.build(tiny, "robustness")
    table = read(planned, "robustness").set_index("id").query("samples > 0")  # it does not reach 0.38
    assert list(table.index) == ["C1a", "C1b", "C3a", "C3c", "C10a", "C10b", "C10c", "C10d"]
    assert list(table.samples) == [16] * 4 + [2] * 4
    assert (table.yes_share + table.partly_share + table.no_share).to_numpy() == pytest.approx(1)
    assert len(read(planned, "robustness_verdicts")) == 4 * 17 + 4 * 3
    blades = list((planned.results / "robustness" / "blades").glob("*/reduced_model.h5"))
    assert len(blades) == 3  # two of the samples, one of the study's own values

    assert planned.plan(tiny, "robustness") == {}
    assert planned.plan(tiny) == {}

    lost = planned.results / "robustness" / "lobes" / "1" / "verdicts.csv"
    said = lost.read_bytes()
    lost.unlink()
    (planned.results / "tables" / "robustness.csv").unlink()
    assert planned.plan(tiny, "robustness") == {"variation": 1, "robustness": 1}
    planned.build(tiny, "robustness")
    assert lost.read_bytes() == said

    more = {**ROBUSTNESS["parts"], "angle": {**ROBUSTNESS["parts"]["angle"], "samples": 4}}
    write(planned, "robustness", ROBUSTNESS | {"parts": more})
    assert planned.plan(tiny, "robustness") == {"variation": 1, "robustness": 1}


@pytest.mark.nightly
def test_waves_follow_one_another_and_a_lost_job_is_made_anew_alone(planned, tiny):
    planned.build(tiny, "identify")
    sets = read(planned, "identification_sets").pivot(index="set", columns="factor", values="value")
    assert len(sets) == 20
    assert sets.unit[0] == pytest.approx(6.0e8)  # the study's own
    assert sets.unit[1] == pytest.approx(3.0e8)
    assert set(sets.tip_turns) == {0, 1}
    assert list(read(planned, "identification_waves").sets) == [16, 20]
    assert set(read(planned, "identification_targets")["id"]) == {"C10a", "C10b", "C10c", "C10d"}
    counts = read(planned, "identification_counts")
    assert list(counts.candidate) == [0, 0, 1, 1]
    assert counts.parts.nunique() == 1  # of all claims that the study can judge
    assert planned.plan(tiny, "identify") == {}

    lost = planned.results / "identification" / "wave2" / "0" / "quantities.csv"
    said = lost.read_bytes()
    lost.unlink()
    (planned.results / "tables" / "identification_counts.csv").unlink()
    assert planned.plan(tiny, "identify")["variation"] == 1 + 4
    planned.build(tiny, "identify")
    assert lost.read_bytes() == said


@pytest.mark.parametrize(
    ("target", "plan", "problem"),
    [
        ("robustness", ROBUSTNESS | {"factors": {}}, "factors = {}:"),
        ("identify", IDENTIFICATION | {"waves": [8, 4]}, "waves = [8, 4]: the first must be at least 14"),
        ("identify", IDENTIFICATION | {"sets": {"soft": {"unt": 1.0}}}, "sets.soft.unt = 1.0: "),
        ("calibration", {"sets": {"odd": {"contact": {"damping_ratio": 2}}}}, "odd: contact.damping_ratio"),
    ],
)
def test_a_bad_plan_is_refused_before_any_work(workspace, tiny, target, plan, problem):
    name = "identification" if target == "identify" else target
    write(workspace, name, plan)
    done = workspace.snakemake(target, "--dry-run", config=tiny)
    assert done.returncode == 2
    assert re.search(rf"config/{name}.yaml:\d+: {re.escape(problem)}", done.stderr)
    assert not workspace.results.exists()
    assert workspace.plan(tiny)["blade"] == 1  # a study needs no plan
