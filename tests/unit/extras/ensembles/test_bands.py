from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from bladerub.extras.ensembles import bands
from bladerub.extras.ensembles.bands import band
from bladerub.extras.ensembles.ensemble import Ensemble
from bladerub.extras.ensembles.figure import peak_bands
from bladerub.extras.further_columns import with_further
from bladerub.io import tables
from bladerub.study import divergence, findings, peak_table
from bladerub.study.grid import CoatingCase

CASE, OTHER = CoatingCase("2nd", 1.1, 0.5, 0.0), CoatingCase("2nd", 2.0, 0.5, 0.0)
SPEEDS = [0.1, 0.15, 0.2, 0.22, 0.3, 0.35, 0.4]
HEIGHTS = (4.5e-4, 6.5e-4, 5.5e-4)


def test_a_band_is_that_of_the_closed_form_and_missing_draws_do_not_count():
    half = stats.t(2).ppf((1 + bands.PROBABILITY) / 2) * np.sqrt(7 * 4 / 3)
    assert bands.PROBABILITY == 0.9
    assert band([1.0, np.nan, 2.0, np.inf, 6.0]) == pytest.approx((2.0, 3 - half, 3 + half))
    assert band([np.nan, 3.0])[0] == 3.0
    assert np.isnan(band([np.nan, 3.0])[1:]).all()
    assert np.isnan(band([])).all()


@pytest.fixture
def maps(make_map):
    """Two coatings, the second without an ensemble."""
    return [make_map(case, {4: (0.3, 2e-4), 6: (0.2, 5e-4)}, SPEEDS) for case in (CASE, OTHER)]


@pytest.fixture
def ensembles(make_map):
    """Members of which f6 and Y6 vary; the second one grows at 0.2."""
    members = []
    for number, height in enumerate(HEIGHTS):
        f_peak = 0.22 if number == 2 else 0.2
        whole = make_map(CASE, {4: (0.3, 2e-4), 6: (f_peak, height)}, [0.15, 0.2, 0.22])
        if number == 1:
            whole.revolution_amplitude[1] *= 1.05 ** np.arange(20)
            whole.lobes[1] = 4
        members.append(replace(whole, wear_node=None))
    finer = make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 5.03e-4)}, [0.15, 0.2, 0.22])
    return [Ensemble(np.zeros((3, 3)), tuple(members), replace(finer, wear_node=None))]


def test_peaks_and_runs_have_the_band_of_all_draws(config, maps, ensembles):
    table = bands.of_peaks(config, maps, ensembles)
    assert set(table.modulus_unit) == {config["contact"]["modulus_unit"]}
    pd.testing.assert_frame_equal(table.iloc[:, :8], peak_table.table(config, maps))
    of_six, of_four = (table[(table.E == 1.1) & (table.order == order)].iloc[0] for order in (6, 4))
    expected = band([5e-4, *HEIGHTS])
    assert of_six.draws == 4
    assert of_six[["amplitude_median", "amplitude_low", "amplitude_high"]].tolist() == pytest.approx(expected)
    assert (of_six.f_peak_median, of_six.f_peak_error) == (0.2, 0)
    assert table[table.E == 2].amplitude_error.isna().all()  # without an ensemble
    assert of_six.f_peak_high > 0.22
    assert of_six.amplitude_error == pytest.approx(4e-6, rel=1e-3)
    assert of_four.amplitude_low == pytest.approx(of_four.amplitude_high) == pytest.approx(2e-4)
    config["analysis"]["divergence"]["confirmation_revolutions"] = 0
    table = bands.of_runs(config, maps, ensembles)
    assert list(table.columns) == bands.RUN_COLUMNS
    found = table.set_index("f_omega")
    assert list(found.index) == [0.15, 0.2, 0.22]
    assert list(found.E.unique()) == [1.1]
    assert list(found.divergent_draws) == [0, 0.25, 0]
    assert (found.lobes_lowest[0.2], found.lobes_highest[0.2]) == (4, 6)
    assert found.growth_rate_high[0.2] > 0.05 > 0.01 > found.growth_rate_median[0.2]
    median = np.median([5e-4, 4.5e-4, 6.5e-4, 1.1e-4])
    assert found.max_wear_median[0.2] == pytest.approx(0.5 * median, rel=0.1)


def test_bands_stand_beside_the_numbers_that_they_are_of(config, maps, ensembles, tmp_path):
    runs, beside = tmp_path / "divergence.csv", tmp_path / "run_bands.csv"
    divergence.table(config, maps).to_csv(runs, index=False)
    assert with_further(tables.read(runs), beside).equals(tables.read(runs))
    bands.of_runs(config, maps, ensembles).to_csv(beside, index=False)
    joined = with_further(tables.read(runs), beside)
    pd.testing.assert_frame_equal(joined[divergence.COLUMNS], tables.read(runs))
    assert list(joined.dropna(subset=["draws"]).f_omega) == [0.15, 0.2, 0.22]
    later = tables.read(runs).assign(growth_per_revolution=0.5)  # of a blade since changed
    assert with_further(later, beside).draws.isna().all()


def test_a_verdict_has_the_share_of_draws_that_agree(config, maps, ensembles, monkeypatch):
    heights = []

    def judge(evidence, claims):
        assert [claim.id for claim in claims] == ["C1a", "C9a", "C10a"]  # not those that the study left out
        heights.append(evidence.peak(CASE, 6, "amplitude"))
        assert len(evidence.divergence) == 14
        assert evidence.rom_accuracy == "accuracy"
        return pd.DataFrame({"id": ["C9a", "C1a"], "holds": ["yes" if heights[-1] > 6e-4 else "no", "yes"]})

    monkeypatch.setattr(findings, "judge", judge)
    table = pd.DataFrame({"id": ["C1a", "C9a", "C10a"], "holds": ["yes", "no", "yes"]})
    found = bands.of_findings(config, table, "accuracy", maps, ensembles)
    assert heights == pytest.approx([*HEIGHTS, 5.03e-4])
    assert list(found.holds_refined.fillna("left out")) == ["yes", "no", "left out"]
    assert list(found.share_of_draws) == pytest.approx([1, 2 / 3, 0])
    assert list(found.draws) == [3, 3, 3]


def test_half_a_band_stands_below_the_value_where_it_shows(draws):
    peaks = pd.DataFrame({"E": [1.1, 2.0, 1.1, 2.0], "K": 0.5, "order": [4, 4, 6, 6], "f_peak": 0.3})
    peaks = peaks.assign(amplitude=2e-3, f_peak_low=0.291, f_peak_high=0.309)
    peaks = peaks.assign(amplitude_low=[1.999e-3, 1.5e-3, np.nan, 1.81e-3])
    peaks = peaks.assign(amplitude_high=[2.001e-3, 2.5e-3, np.nan, 2.19e-3])
    axes = draws(peak_bands(peaks, 600e6)).axes
    texts = [[text.get_text() for text in panel.texts] for panel in axes[:3]]
    assert texts == [["2.00", "2.00\n±0.50"], 2 * ["0.300\n±0.009"], ["2.00", "2.00\n±0.19"]]
