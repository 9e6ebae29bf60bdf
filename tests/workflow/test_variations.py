"""Plans that vary what the paper leaves open, and rows of blades: complete, restartable."""

import re

import pytest
import yaml

from bladerub.io import tables
from bladerub.study.store import read_run

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


COATING = {"casing": "2nd", "E": 2, "K": 0.5, "theta": 0.0}
SCATTER = {"length_scatter": [0, 5.0e-5], "frequency_scatter": [0.01], "coupling": [0.01]}
GROUP = COATING | {"f_omega": [0.19], "blades": [3]} | SCATTER | {"draws": 3}
SWEEP = GROUP | {"f_omega": [0.19, 0.25], "length_scatter": [5.0e-5], "draws": 2}
PATTERN = GROUP | {"length_scatter": [5.0e-5], "draws": 2}
PLAN = {
    "seed": 1,
    "groups": {"small": GROUP},
    "sweeps": {"two_speeds": SWEEP},
    "patterns": {"harmonic": 4, "interval": 1, "groups": {"some": PATTERN}},
}

TAIL = dict.fromkeys(("rotor_tables", "rotor_figure", "rotor_sweeps_figure", "rotor_patterns", "rotor"), 1)


@pytest.mark.nightly
def test_rows_are_made_once_and_lost_or_changed_ones_alone(copied_study, tiny):
    write(copied_study, "rotor", PLAN)
    assert copied_study.plan(tiny, "rotor") == TAIL | {"rotor_combination": 5}
    copied_study.build(tiny, "rotor")
    draws = tables.read(copied_study.results / "tables" / "rotor_draws.csv")
    table = tables.read(copied_study.results / "tables" / "rotor.csv")
    assert len(table) == 5
    assert len(draws) == table.rows.sum() == 2 * 3 + 1 + 2 + 1
    assert (draws.energy_residual < 1e-3).all()
    assert draws.divergent.dtype == bool
    alone = table[(table.blades == 1) & (table.frequency_scatter == 0)]
    assert alone.amplification_median.tolist() == [1.0, 1.0]
    drift = tables.read(copied_study.results / "tables" / "rotor_drift.csv")
    assert drift[["blades", "rows", "followed_rows"]].values.tolist() == [[1, 1, 1], [3, 2, 2]]
    assert copied_study.plan(tiny, "rotor") == {}

    folder = next((copied_study.results / "rotor" / "runs").glob("*_f0.1900_n3_l5e-05_d0.01_c0.01"))
    times = copied_study.runs()
    (folder / "0001.h5").unlink()
    (folder / "0002.h5").write_bytes(b"broken")
    counted = copied_study.status()["rows_of_blades"]
    assert (counted["planned"], counted["done"], counted["missing"], counted["corrupt"]) == (10, 8, 1, 1)
    copied_study.status("--discard")
    assert not (folder / "0002.h5").exists()
    copied_study.build(tiny, "rotor")
    again = copied_study.runs()
    assert {name[-7:] for name in times if times[name] != again[name]} == {"0001.h5", "0002.h5"}

    write(copied_study, "rotor", PLAN | {"groups": {"small": GROUP | {"draws": 4}}})
    assert copied_study.plan(tiny, "rotor") == TAIL | {"rotor_combination": 2}
    copied_study.build(tiny, "rotor")
    assert len(tables.read(copied_study.results / "tables" / "rotor_draws.csv")) == 2 * 4 + 1 + 2 + 1
    more = copied_study.runs()
    assert {name[-7:] for name in more if more[name] != again.get(name)} == {"0003.h5"}


def test_a_study_may_be_of_rows_throughout(copied_study, tiny):
    rotor = {"blades": 2, "length": [0.0, 5.0e-5], "frequency_scatter": 0.01, "coupling": [0.01]}
    target = "results/maps/2nd_E2_K0.5_theta0.h5"
    copied_study.build(tiny | {"rotor": rotor}, target)
    folder = copied_study.results / "runs" / "2nd_E2_K0.5_theta0"
    run = read_run(folder / "0.1900.h5")
    assert run.data["blade_length"].tolist() == [0.0, 5.0e-5]
    assert run.attributes["energy_residual"] < 1e-3
    assert copied_study.plan(tiny | {"rotor": rotor}, target) == {}
    wrong = copied_study.snakemake("-n", target, config=tiny | {"rotor": rotor | {"length": [0.0] * 3}})
    assert wrong.returncode == 2
    assert "rotor: 3 values of length; must be 1 or 2" in wrong.stderr
