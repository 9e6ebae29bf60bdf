import itertools
from dataclasses import replace

import h5py
import numpy as np
import pandas as pd
import pytest
from scipy import stats
from study_fixtures import changed

from bladerub.extras.ensembles import bands, ensemble
from bladerub.extras.ensembles.ensemble import Ensemble, expected_cost
from bladerub.extras.ensembles.figure import peak_bands
from bladerub.extras.ensembles.settings import Ensemble as Settings
from bladerub.extras.further_columns import with_further
from bladerub.extras.study_runs import chosen, judged, nearest_speed, on_lobes
from bladerub.io import tables
from bladerub.io.errors import BadInput
from bladerub.study import divergence, findings, peaks
from bladerub.study.grid import CoatingCase, run_spec, speeds
from bladerub.study.paper import WORN

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)
SETTINGS = Settings(members=8, displacement=1e-7, seed=1)


@pytest.fixture
def study(config):
    """Seven speeds, peaks at 0.2 and 0.3, two members."""
    grid = {"start": 0.1, "stop": 0.4, "step": 0.05, "extra": []}
    analysis = {"max_order": 24.0}  # as `make_map`
    return changed(config, speeds=grid, ensemble={"members": 2}, analysis=analysis)


@pytest.fixture
def coating(study, make_map):
    return make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 5e-4)}, speeds(study))


@pytest.fixture
def made(study, coating, blade, make_result, solve_by, tmp_path):
    """Make the ensembles of the coating by a stand-in for the solver, whose runs are listed as specs."""
    specs, blade = [], replace(blade, f_omega_max=0.5)

    def simulate(spec):
        specs.append(spec)
        grows = spec.f_omega == 0.2 and spec.initial_displacement > 0 and spec.revolutions == 20
        height = 1e-3 + 1e3 * spec.initial_displacement
        return make_result(spec.revolutions, amplitude=height, growth=0.04 if grows else 0.0)

    solve_by(simulate)

    def make(config=study, report=lambda line: None):
        return ensemble.make(config, coating, blade, "blade", tmp_path / "runs", tmp_path / "e.h5", report)

    make.specs, make.path, make.runs = specs, tmp_path / "e.h5", tmp_path / "runs" / ensemble.FOLDER
    return make


def test_starts_lie_on_both_sides_and_are_those_of_their_run_and_seed_alone():
    more = ensemble.starts(SETTINGS, CASE, 0.2, 100)
    assert np.abs(more).max() <= 1e-7
    assert np.quantile(more, 0.1) < -5e-8 < 5e-8 < np.quantile(more, 0.9)
    np.testing.assert_array_equal(ensemble.starts(SETTINGS, CASE, 0.2, 8), more[:8])
    settings, cases = (SETTINGS, SETTINGS.replaced("seed", 2)), (CASE, replace(CASE, theta=0.15))
    of_each = itertools.product(settings, cases, (0.2, 0.21))
    assert len({tuple(ensemble.starts(*of, 4)) for of in of_each}) == 8


def test_peaks_with_their_neighbours_and_runs_whose_displacement_is_kept_are_chosen(study, coating, make_map):
    np.testing.assert_array_equal(chosen(study, coating), [0.15, 0.2, 0.25, 0.3, 0.35])
    for theta in (0.0, 0.15):
        history = {"casing": "2nd", "E": 1.1, "K": 0.5, "theta": theta, "f_omega": 0.1}
        speeds_chosen = chosen(changed(study, analysis={"histories": [history]}), coating)
        assert (0.1 in speeds_chosen) == (theta == 0)
    unbounded = make_map(CASE, {})
    unbounded.spectrum_amplitude[(unbounded.f_omega > 0.1) & (unbounded.f_omega < 0.25)] = np.nan
    settings = study.analysis.peaks
    without_a_peak = [(make_map(CASE, {}, [0.05, 0.1, 0.3]), 6, 0.1), (unbounded, 6, 0.17)]
    for each, order, nearest in [*without_a_peak, (make_map(CASE, {}), 2, 0.4)]:  # where it meets C1
        assert each.f_omega[nearest_speed(each, order, settings)] == nearest


def test_members_are_the_study_s_run_from_other_starts_each_is_repeated_finer_and_read_again(
    made, study, coating
):
    made()
    spec = made.specs[0]
    assert spec == replace(run_spec(study, CASE, 0.15), initial_displacement=spec.initial_displacement)
    runs = [spec for spec in made.specs if spec.revolutions == 20]
    assert len({spec.initial_displacement for spec in runs if spec.tolerance == 0.01}) == 10
    finer = [spec for spec in made.specs if spec.tolerance != 0.01]
    assert [spec.f_omega for spec in finer] == [0.15, 0.2, 0.25, 0.3, 0.35]
    assert finer[0] == replace(run_spec(study, CASE, 0.15), tolerance=0.0025)
    with h5py.File(made.path) as file:  # they count from 1, as in maps and in the names of runs
        assert [file[name][:2].tolist() for name in ("member", "revolution_number")] == [[1, 2], [1, 2]]
    read = ensemble.read(made.path)
    np.testing.assert_allclose(read.refined.spectrum_amplitude[:, 60], 1e-3, rtol=1e-3)
    starts = [ensemble.starts(study.ensemble, CASE, f, 2) for f in (0.15, 0.2, 0.25, 0.3, 0.35)]
    np.testing.assert_array_equal(read.start, np.transpose(starts))
    assert [member.case for member in read.members] == [CASE, CASE]
    steady = [0, 2, 3, 4]
    heights = read.members[1].spectrum_amplitude[steady, 60]
    np.testing.assert_allclose(heights, 1e-3 + 1e3 * read.start[1, steady], rtol=1e-3)
    drawn = read.draw(coating, read.members[1])  # the runs of one member, those of the study elsewhere
    at = np.isin(coating.f_omega, read.members[1].f_omega)
    for name in ("spectrum_amplitude", "wear", "lobes", "status", "max_wear", "revolution_amplitude"):
        np.testing.assert_array_equal(getattr(drawn, name)[at], getattr(read.members[1], name))
        np.testing.assert_array_equal(getattr(drawn, name)[~at], getattr(coating, name)[~at])
    assert np.isnan(drawn.confirmation_amplitude[~at]).all()
    np.testing.assert_array_equal(drawn.f_omega, coating.f_omega)


def test_nothing_is_computed_twice_and_more_members_are_added(made, study):
    made()
    before = len(made.specs)
    made()
    assert len(made.specs) == before
    (made.runs / "0.2500_2.h5").unlink()
    made(study.replaced("ensemble.members", 3))
    later = [spec.f_omega for spec in made.specs[before:] if spec.revolutions == 20]
    assert later == [0.25, 0.15, 0.2, 0.25, 0.3, 0.35]


def test_each_peak_has_three_speeds_each_history_its_own_and_claims_on_lobes_theirs(config):
    config = changed(config, ensemble={"members": 2}, analysis={"histories": []})
    assert expected_cost(config, CASE) == (2 + 2) * 3 * 2
    history = {"casing": "2nd", "E": 1.1, "K": 0.5, "theta": 0.0}
    config = changed(config, analysis={"histories": [history | {"f_omega": f} for f in (0.1, 0.2)]})
    assert expected_cost(config, CASE) == (2 + 2) * (2 + 3 * 2)
    assert expected_cost(config.replaced("ensemble.members", 0), CASE) == 0
    with pytest.raises(BadInput, match=r"ensemble.members = 0"):
        ensemble.make(config.replaced("ensemble.members", 0), *7 * [None])


def test_runs_of_claims_on_lobes_are_repeated_and_not_followed(study, make_map):
    f_omega = np.arange(0.02, 0.4, 0.002)
    at_lobes = on_lobes(WORN, f_omega)
    assert at_lobes.sum() > 100
    assert not at_lobes[(f_omega > 0.15) & (f_omega < 0.2)].any()
    assert not on_lobes(CASE, f_omega).any()
    near_peaks = [0.15, 0.17, 0.2, 0.25, 0.3, 0.35]
    worn = make_map(WORN, {4: (0.3, 2e-4), 6: (0.17, 2e-4)}, [0.05, 0.07, *near_peaks])
    np.testing.assert_array_equal(judged(study, worn), near_peaks)
    plans = ensemble.plan(study, worn)
    assert len(plans) == study.ensemble.members + 1
    for member in plans:
        assert [run.spec.f_omega for run in member.runs] == list(worn.f_omega)
        assert [run.follow for run in member.runs] == [False] * 2 + [True] * 6


OTHER = CoatingCase("2nd", 2.0, 0.5, 0.0)
SPEEDS = [0.1, 0.15, 0.2, 0.22, 0.3, 0.35, 0.4]
HEIGHTS = (4.5e-4, 6.5e-4, 5.5e-4)


def test_a_band_is_that_of_the_closed_form_and_missing_draws_do_not_count():
    half = stats.t(2).ppf((1 + bands.PROBABILITY) / 2) * np.sqrt(7 * 4 / 3)
    assert bands.PROBABILITY == 0.9
    assert bands.band([1.0, np.nan, 2.0, np.inf, 6.0]) == pytest.approx((2.0, 3 - half, 3 + half))
    assert bands.band([np.nan, 3.0])[0] == 3.0
    assert np.isnan(bands.band([np.nan, 3.0])[1:]).all()
    assert np.isnan(bands.band([])).all()


@pytest.fixture
def maps(make_map):
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
    assert set(table.modulus_unit) == {config.contact.modulus_unit}
    pd.testing.assert_frame_equal(table.iloc[:, :8], peaks.table(config, maps))
    of_six, of_four = (table[(table.E == 1.1) & (table.order == order)].iloc[0] for order in (6, 4))
    expected = bands.band([5e-4, *HEIGHTS])
    assert of_six[["amplitude_median", "amplitude_low", "amplitude_high"]].tolist() == pytest.approx(expected)
    assert (of_six.draws, of_six.f_peak_median, of_six.f_peak_error) == (4, 0.2, 0)
    assert table[table.E == 2].amplitude_error.isna().all()  # without an ensemble
    assert of_six.f_peak_high > 0.22
    assert of_six.amplitude_error == pytest.approx(4e-6, rel=1e-3)
    assert of_four.amplitude_low == pytest.approx(of_four.amplitude_high) == pytest.approx(2e-4)
    config = config.replaced("analysis.divergence.confirmation_revolutions", 0)
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


def test_runs_that_are_not_followed_have_no_judgement(config, maps, ensembles, monkeypatch):
    monkeypatch.setattr(bands, "judged", lambda config, coating: [0.15, 0.2])
    runs = bands.of_runs(config, maps, ensembles).set_index("f_omega")
    assert runs[bands.JUDGED_COLUMNS].isna().all(axis="columns").tolist() == [False, False, True]
    assert runs.max_wear_median.notna().all()


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
    peaks = pd.DataFrame({"E": [1.1, 2.0], "K": 0.5, "order": [4, 6], "f_peak": 0.3, "amplitude": 2e-3})
    peaks = peaks.assign(f_peak_low=0.291, f_peak_high=0.309)
    peaks = peaks.assign(amplitude_low=[1.5e-3, np.nan], amplitude_high=[2.5e-3, np.nan])
    panels = draws(peak_bands(peaks, 600e6)).axes[:3]
    texts = [[text.get_text() for text in panel.texts] for panel in panels]
    assert texts == [["2.00\n±0.50"], ["0.300\n±0.009"], ["2.00"]]
