"""The design over all that the paper leaves open, by the real workflow: complete, and restartable."""

import pytest
import yaml

from bladerub.io import tables

PLAN = {
    "seed": 1,
    "factors": {
        "unit": {"unit": "Pa", "scale": "log", "sets": {"contact.modulus_unit": [2.0e8, 8.0e8]}},
        "lean": {"unit": "degrees", "sets": {"blade.tip_cone": [12.0, 13.0]}, "multiple_of": 1},
        "step": {"unit": "1", "sets": {"speeds.step": [0.03, 0.05]}, "multiple_of": 0.005},
    },
    "parts": {
        "lobes": {
            "claims": ["C1", "C3"],
            "samples": 16,
            "study": {
                "coatings": [{"casing": "2nd5nd", "E": [11], "K": [0.5], "theta": [0.0]}],
                "analysis": {"histories": []},
            },
        },
        "angle": {
            "claims": ["C10"],
            "samples": 2,
            "study": {
                "coatings": [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]}],
                "analysis": {"histories": []},
            },
        },
    },
}


@pytest.fixture
def planned(copied_study, tiny):
    (copied_study.folder / "config" / "robustness.yaml").write_text(yaml.safe_dump(PLAN, sort_keys=False))
    return tiny


def test_the_design_is_planned(copied_study, planned):
    assert copied_study.plan(planned, "robustness") == {
        "robustness_blade": 3,  # two of the samples, one of the study's own values
        "robustness_batch": 5,
        "robustness": 1,
    }


@pytest.mark.nightly
def test_the_design_is_made_once_and_a_lost_job_is_made_anew_alone(copied_study, planned):
    copied_study.build(planned, "robustness")
    folder = copied_study.results / "tables"
    table = tables.read(folder / "robustness.csv").set_index("id")
    assert list(table.index[4:6]) == ["C3c", "C3d"]
    table = table[table.samples > 0]  # the tiny study does not reach 0.38
    assert list(table.index) == ["C1a", "C1b", "C3a", "C3c", "C10a", "C10b", "C10c", "C10d"]
    assert (table.samples[:4] == 16).all()
    assert (table.samples[4:] == 2).all()
    assert (table.yes_share + table.partly_share + table.no_share).to_numpy() == pytest.approx(1)
    assert (table.runs_per_sample > 0).all()
    design = tables.read(folder / "robustness_design.csv")
    assert len(design) == 16 * 3
    assert set(design.value[design.factor == "lean"]) == {12, 13}
    assert len(tables.read(folder / "robustness_verdicts.csv")) == 4 * 17 + 4 * 3
    assert (copied_study.results / "figures" / "robustness.png").stat().st_size > 10_000

    assert copied_study.plan(planned, "robustness") == {}
    before = tables.read(folder / "findings.csv")
    assert before.robustness.isna().all()
    anew = copied_study.plan(planned)
    assert "findings" in anew
    assert not {"coating", "robustness_batch"} & anew.keys()
    copied_study.build(planned)
    reported = tables.read(folder / "findings.csv").set_index("id")
    alike = reported.holds[table.index] == table.reference
    assert alike.any()
    assert (reported.robustness[table.index][alike] == table.yes_share[alike]).all()
    assert reported.robustness.drop(table.index[alike]).isna().all()
    assert copied_study.plan(planned) == {}

    planned["figures"] = {"dpi": 90}
    assert copied_study.plan(planned, "robustness") == {"robustness": 1}  # the picture

    lost = copied_study.results / "robustness" / "lobes" / "1" / "verdicts.csv"
    said = lost.read_bytes()
    lost.unlink()
    (folder / "robustness.csv").unlink()
    assert copied_study.plan(planned, "robustness") == {"robustness_batch": 1, "robustness": 1}
    copied_study.build(planned, "robustness")
    assert lost.read_bytes() == said

    more = PLAN | {"parts": {**PLAN["parts"], "angle": {**PLAN["parts"]["angle"], "samples": 4}}}
    (copied_study.folder / "config" / "robustness.yaml").write_text(yaml.safe_dump(more, sort_keys=False))
    assert copied_study.plan(planned, "robustness") == {"robustness_batch": 1, "robustness": 1}
