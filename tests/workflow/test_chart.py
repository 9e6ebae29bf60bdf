"""The chart of coatings on the real workflow: complete, restartable, and equal to the study."""

import copy

import pandas as pd
import pytest
from workspace import TINY

from bladerub.io import tables

FIGURES = ["Y4", "f4", "Y6", "f6", "peak", "worn_volume", "divergent_share", "safe", "pareto"]
FIGURES += ["explanation", "stiffening"]
AGREEMENT = "results/tables/chart_agreement.csv"
CHART = {"chart": {"E": [0.11, 2], "K": [0.5, 5], "theta": [0.0]}}


@pytest.fixture
def charted(tiny):
    return tiny | copy.deepcopy(CHART)


@pytest.fixture(scope="module")
def complete(study, tmp_path_factory):
    """The tiny study with its chart; tests leave it as it is."""
    complete = study.copy(tmp_path_factory.mktemp("chart") / "complete")
    complete.build(TINY | CHART, "chart", AGREEMENT)
    return complete


@pytest.fixture
def copied_chart(complete, tmp_path):
    """A copy of it that a test may change."""
    return complete.copy(tmp_path / "copy")


def files(workspace):
    return {
        path.name: path.stat().st_mtime_ns for path in (workspace.results / "chart" / "cells").glob("*.h5")
    }


def test_the_chart_is_planned(study, charted):
    plan = study.plan(charted, "chart")
    assert plan["chart_column"] == len(charted["chart"]["E"])


@pytest.mark.nightly
def test_the_chart_is_drawn_once_and_a_lost_cell_is_made_anew_alone(copied_chart, charted):
    for name in FIGURES:
        assert (copied_chart.results / "figures" / f"chart_{name}.png").stat().st_size > 10_000
    chart = tables.read(copied_chart.results / "tables" / "chart.csv")
    assert len(chart) == 4
    assert (chart.runs == 8).all()

    # E = 0.11 and 2 with K = 0.5 are coatings of the study as well, at the same speeds
    agreement = tables.read(copied_chart.folder / AGREEMENT)
    assert len(agreement) == 2 * 3
    assert (agreement.in_chart == agreement.greatest).all()
    in_study = tables.read(copied_chart.results / "tables" / "peaks.csv")
    both = pd.merge(chart, in_study, on=["casing", "E", "K", "theta"])
    for order in (4, 6):
        of_order = both[both.order == order]
        assert len(of_order) == 2
        assert (of_order[f"Y{order}"] == of_order.amplitude).all()
        assert (of_order[f"f{order}"] == of_order.f_peak).all()

    assert copied_chart.plan(charted, "chart") == {}
    before = files(copied_chart)
    lost = "2nd_E2_K5_theta0.h5"
    (copied_chart.results / "chart" / "cells" / lost).unlink()
    copied_chart.build(charted, "results/chart/columns/2nd_E2_theta0.tsv")
    after = files(copied_chart)
    assert after.keys() == before.keys()
    assert {name for name in after if after[name] != before[name]} == {lost}

    charted["chart"]["K"].insert(1, 1)
    assert copied_chart.plan(charted, "results/chart/columns/2nd_E2_theta0.tsv") == {"chart_column": 1}
    copied_chart.build(charted, "results/chart/columns/2nd_E2_theta0.tsv")
    assert files(copied_chart).items() > after.items()


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
