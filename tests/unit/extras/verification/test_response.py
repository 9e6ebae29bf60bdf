import pandas as pd

from bladerub.extras.verification.response import listed


def peaks(*rows):
    return pd.DataFrame(rows, columns=["casing", "E", "K", "theta", "order", "f_peak", "law"])


def test_of_a_study_without_these_all_coatings_are_listed():
    table = peaks(
        ("bumps", 1.0, 0.5, 0.0, 4, 0.31, "theta"),
        ("bumps", 1.0, 0.5, 0.0, 6, 0.19, "theta"),
        ("bumps", 1.0, 0.5, float("nan"), 6, 0.19, "coulomb"),
    )
    assert [(case.casing, peak.f_peak) for case, peak in listed(table)] == [("bumps", 0.31), ("bumps", 0.19)]
