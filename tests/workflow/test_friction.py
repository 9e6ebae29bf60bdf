"""Both laws of friction by a rule of the workflow, on the tiny study."""

import pandas as pd


def test_both_laws_are_compared_when_asked_for(copied_study, tiny):
    tiny["friction"] = [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.15]}]
    plan = copied_study.plan(tiny, "friction")
    assert plan == {"coating": 1, "friction": 1}  # the one with theta is of the study
    copied_study.build(tiny, "friction")
    table = pd.read_csv(copied_study.results / "tables" / "friction.csv")
    assert list(table.f_omega) == [0.15, 0.19, 0.197, 0.206, 0.23, 0.27, 0.31, 0.35]
    assert (table.reversed_theta == 0).all()
    assert (table.reversed_coulomb == 0).all()
    assert table.slowest_sliding.between(0, 1, inclusive="neither").all()
    assert table.difference.abs().max() < 1e-6
    assert (table.peak_theta > 0).all()
    assert (copied_study.results / "figures" / "friction.png").stat().st_size > 10_000
    assert copied_study.plan(tiny) == {}  # and the study has no part in it
