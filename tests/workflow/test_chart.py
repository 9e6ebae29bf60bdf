"""The chart of coatings on the real workflow: complete, restartable, and equal to the study."""

import pytest

from bladerub.io import tables

AGREEMENT = "results/tables/chart_agreement.csv"


def files(workspace):
    cells = workspace.results / "chart" / "cells"
    return {path.name: path.stat().st_mtime_ns for path in cells.glob("*.h5")}


@pytest.mark.nightly
def test_the_chart_is_drawn_once_and_a_lost_cell_is_made_anew_alone(copied_study, tiny):
    charted = tiny | {"chart": {"E": [0.11, 2], "K": [0.5, 5], "theta": [0.0]}}
    copied_study.build(charted, "chart", AGREEMENT)
    chart = tables.read(copied_study.results / "tables" / "chart.csv")
    assert chart.runs.tolist() == [8] * 4
    # E = 0.11 and 2 with K = 0.5 are coatings of the study as well, at the same speeds
    agreement = tables.read(copied_study.folder / AGREEMENT)
    assert len(agreement) == 2 * 3
    assert (agreement.in_chart == agreement.greatest).all()

    assert copied_study.plan(charted, "chart") == {}
    before, lost = files(copied_study), "2nd_E2_K5_theta0.h5"
    (copied_study.results / "chart" / "cells" / lost).unlink()
    copied_study.build(charted, "results/chart/columns/2nd_E2_theta0.tsv")
    after = files(copied_study)
    assert {name for name in before if after[name] != before[name]} == {lost}
