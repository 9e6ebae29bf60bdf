import itertools
from dataclasses import replace

import numpy as np
import pytest

from bladerub.extras.ensembles import ensemble
from bladerub.extras.ensembles.ensemble import expected_cost
from bladerub.extras.important_runs import chosen, named, nearest_speed
from bladerub.study.grid import CoatingCase, run_spec, speeds
from bladerub.study.paper import WORN

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)
SETTINGS = {"members": 8, "displacement": 1e-7, "seed": 1}


@pytest.fixture
def study(config):
    """Seven speeds, peaks at 0.2 and 0.3, two members."""
    config["speeds"] = {"start": 0.1, "stop": 0.4, "step": 0.05, "extra": []}
    config["ensemble"] = SETTINGS | {"members": 2}
    config["analysis"]["max_order"] = 24.0  # as `make_map`
    return config


@pytest.fixture
def coating(study, make_map):
    return make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 5e-4)}, speeds(study))


@pytest.fixture
def blade(blade):
    return replace(blade, f_omega_max=0.5)


@pytest.fixture
def made(study, coating, blade, make_result, monkeypatch, tmp_path):
    """Make the ensembles of the coating by a stand-in for the solver, whose runs are listed as specs."""
    specs = []

    def simulate(_, spec, progress=None):
        specs.append(spec)
        grows = spec.f_omega == 0.2 and spec.initial_displacement > 0 and spec.revolutions == 20
        height = 1e-3 + 1e3 * spec.initial_displacement
        return make_result(spec.revolutions, amplitude=height, growth=0.04 if grows else 0.0)

    monkeypatch.setattr("bladerub.contact.run.simulate", simulate)

    def make(report=lambda line: None):
        return ensemble.make(study, coating, blade, "blade", tmp_path / "runs", tmp_path / "e.h5", report)

    make.specs, make.path, make.runs = specs, tmp_path / "e.h5", tmp_path / "runs" / ensemble.FOLDER
    return make


def test_starts_lie_on_both_sides_and_are_those_of_their_run_and_seed_alone():
    more = ensemble.starts(SETTINGS, CASE, 0.2, 100)
    assert np.abs(more).max() <= 1e-7
    assert np.quantile(more, 0.1) < -5e-8 < 5e-8 < np.quantile(more, 0.9)
    np.testing.assert_array_equal(ensemble.starts(SETTINGS, CASE, 0.2, 8), more[:8])
    settings, cases = (SETTINGS, SETTINGS | {"seed": 2}), (CASE, replace(CASE, theta=0.15))
    of_each = itertools.product(settings, cases, (0.2, 0.21))
    assert len({tuple(ensemble.starts(*of, 4)) for of in of_each}) == 8


def test_peaks_with_their_neighbours_and_runs_whose_displacement_is_kept_are_chosen(study, coating, make_map):
    np.testing.assert_array_equal(chosen(study, coating), [0.15, 0.2, 0.25, 0.3, 0.35])
    study["analysis"]["histories"] = [{"casing": "2nd", "E": 1.1, "K": 0.5, "theta": 0.0, "f_omega": 0.1}]
    assert 0.1 in chosen(study, coating)
    study["analysis"]["histories"][0]["theta"] = 0.15
    assert 0.1 not in chosen(study, coating)
    unbounded = make_map(CASE, {})
    unbounded.spectrum_amplitude[(unbounded.f_omega > 0.1) & (unbounded.f_omega < 0.25)] = np.nan
    settings = study["analysis"]["peaks"]
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
    drawn = [spec.initial_displacement for spec in runs if spec.tolerance == 0.01]
    assert np.abs(drawn).min() > 0
    assert len(set(drawn)) == 10
    finer = [spec for spec in made.specs if spec.tolerance != 0.01]
    assert [spec.f_omega for spec in finer] == [0.15, 0.2, 0.25, 0.3, 0.35]
    assert finer[0] == replace(run_spec(study, CASE, 0.15), tolerance=0.0025)
    read = ensemble.read(made.path)
    np.testing.assert_allclose(read.refined.spectrum_amplitude[:, 60], 1e-3, rtol=1e-3)
    starts = [ensemble.starts(study["ensemble"], CASE, f, 2) for f in (0.15, 0.2, 0.25, 0.3, 0.35)]
    np.testing.assert_array_equal(read.start, np.transpose(starts))
    assert [member.case for member in read.members] == [CASE, CASE]
    np.testing.assert_allclose(read.members[1].f_omega, [0.15, 0.2, 0.25, 0.3, 0.35])
    steady = [0, 2, 3, 4]
    heights = read.members[1].spectrum_amplitude[steady, 60]
    np.testing.assert_allclose(heights, 1e-3 + 1e3 * read.start[1, steady], rtol=1e-3)
    drawn = read.draw(coating, read.members[1])  # the runs of one member, those of the study elsewhere
    at = np.isin(coating.f_omega, read.members[1].f_omega)
    for name in ("spectrum_amplitude", "wear", "lobes", "status", "max_wear", "revolution_amplitude"):
        np.testing.assert_array_equal(getattr(drawn, name)[at], getattr(read.members[1], name))
        np.testing.assert_array_equal(getattr(drawn, name)[~at], getattr(coating, name)[~at])
    assert drawn.confirmation_amplitude.shape[0] == coating.f_omega.size
    assert np.isnan(drawn.confirmation_amplitude[~at]).all()
    np.testing.assert_array_equal(drawn.f_omega, coating.f_omega)


def test_nothing_is_computed_twice_and_more_members_are_added(made, study):
    made()
    before = len(made.specs)
    made()
    assert len(made.specs) == before
    study["ensemble"]["members"] = 3
    (made.runs / "0.2500_2.h5").unlink()
    made()
    later = [spec.f_omega for spec in made.specs[before:] if spec.revolutions == 20]
    assert later == [0.25, 0.15, 0.2, 0.25, 0.3, 0.35]


def test_each_peak_has_three_speeds_and_each_history_its_own(config):
    config["ensemble"]["members"] = 2
    config["analysis"]["histories"] = []
    assert expected_cost(config, CASE) == (2 + 2) * 3 * 2
    history = {"casing": "2nd", "E": 1.1, "K": 0.5, "theta": 0.0}
    config["analysis"]["histories"] = [history | {"f_omega": f} for f in (0.1, 0.2)]
    assert expected_cost(config, CASE) == (2 + 2) * (2 + 3 * 2)
    config["ensemble"]["members"] = 0
    assert expected_cost(config, CASE) == 0


def test_the_claims_on_lobes_name_the_speeds_of_one_coating(config):
    listed = np.array(speeds(config))
    at_lobes = named(config, WORN, listed)
    assert at_lobes.sum() > 100
    assert at_lobes[0]
    assert not at_lobes[(listed > 0.15) & (listed < 0.2)].any()
