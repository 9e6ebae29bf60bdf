"""The chart of coatings on the real workflow: complete, restartable, and equal to the study."""

import pytest

from bladerub.io import tables

AGREEMENT = "results/tables/chart_agreement.csv"


@pytest.fixture
def charted(tiny):
    return tiny | {"chart": {"E": [0.11, 2], "K": [0.5, 5], "theta": [0.0]}}


def files(workspace):
    cells = workspace.results / "chart" / "cells"
    return {path.name: path.stat().st_mtime_ns for path in cells.glob("*.h5")}


@pytest.mark.nightly
def test_the_chart_is_drawn_once_and_a_lost_cell_is_made_anew_alone(copied_study, charted):
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


def test_a_chart_without_its_crossing_is_refused_before_any_work(workspace, charted):
    charted["speeds"] |= {"stop": 0.22, "step": 0.02}
    charted["analysis"]["peaks"] = {"orders": [6]}
    ellipse = {"nodal_diameters": [2], "weights": [1.0], "start_angle": 0.0}
    ellipse |= {"amplitude": 1e-3, "interference": 5e-4}
    charted["casings"] = {"other": {**ellipse, "peak_orders": [4, 6]}}
    charted["chart"]["casing"] = "other"  # of no coating: the study is right without it
    done = workspace.snakemake("chart", "--dry-run", config=charted)
    assert done.returncode == 2
    assert "speeds.stop = 0.22: must be at least 0.25 for the chart" in done.stderr
    assert not workspace.results.exists()
