"""What 20 and 60 revolutions can show of growth, on made-up amplitudes with the scatter of real runs."""

import numpy as np
import pytest

from bladerub.settings.analysis import Divergence
from bladerub.study.growth import growth, judge, needs_confirmation

SETTINGS = Divergence(revolutions=10, growth=0.01, confidence=0.95, confirmation_revolutions=60)
NUMBER = np.arange(1.0, 21.0)
LONG = np.arange(1.0, 61.0)


def saturation(number, tau):
    return 1 - np.exp(-number / tau)


def scattered(amplitude, scatter, correlation=0.0, n=300):
    """The amplitude n times, its logarithm with normal scatter that neighbouring revolutions may share."""
    noise = np.random.default_rng(3).standard_normal((n, amplitude.size))
    for i in range(1, amplitude.size):
        noise[:, i] = correlation * noise[:, i - 1] + np.sqrt(1 - correlation**2) * noise[:, i]
    return amplitude * np.exp(scatter * noise)


def share(runs, attribute="grows"):
    return np.mean([getattr(growth(run, SETTINGS), attribute) for run in runs])


@pytest.mark.parametrize("rate", [-0.05, 0.0, 0.03, 0.5])
def test_the_rate_is_that_of_the_exponential_in_the_last_revolutions(rate):
    found = growth(np.r_[2.0 ** np.arange(10), 500 * (1 + rate) ** np.arange(10)], SETTINGS)
    assert found.per_revolution == pytest.approx(rate, abs=1e-12)
    assert found.low < rate < found.high
    assert 4e-4 < found.high - found.low < 1e-3  # however exact the fit


@pytest.mark.parametrize("scatter", [0.01, 0.1])
def test_the_rate_lies_in_its_interval_as_often_as_the_confidence_says(scatter):
    found = [growth(run, SETTINGS) for run in scattered(1.03**NUMBER, scatter, n=1000)]
    assert np.mean([each.low < 0.03 < each.high for each in found]) == pytest.approx(0.95, abs=0.02)


@pytest.mark.parametrize(("begun", "measured"), [(1, "none"), (2, "rate"), (3, "interval")])
def test_few_revolutions_have_no_interval_and_fewer_no_rate(begun, measured):
    amplitude = np.full(20, np.nan)
    amplitude[:begun] = 1.5 ** np.arange(begun)
    found = growth(amplitude, SETTINGS)
    assert np.isfinite(found.per_revolution) == (measured != "none")
    assert np.isfinite(found.low) == np.isfinite(found.high) == found.grows == (measured == "interval")
    assert not found.levels_off
    assert growth(np.zeros(20), SETTINGS)[:4] == (0, 0, 0, False)  # a blade that never moved


@pytest.mark.parametrize(
    ("amplitude", "grows"),
    [
        (1.011**NUMBER, True),
        (1.009**NUMBER, False),
        # an amplitude before must be outgrown by 1.01 ** 10 = 1.1046
        (np.r_[np.ones(10), 1.105 * 1.03 ** np.arange(-9, 1)], True),
        (np.r_[np.ones(10), 1.104 * 1.03 ** np.arange(-9, 1)], False),
    ],
)
def test_growth_is_above_the_threshold_and_outgrows_what_was_before(amplitude, grows):
    assert growth(amplitude, SETTINGS).grows == grows


@pytest.mark.parametrize("scatter", [0.001, 0.05, 0.2])
def test_steady_and_decaying_runs_do_not_grow(scatter):
    assert share(scattered(np.ones(20), scatter)) <= 0.02
    assert share(scattered(np.ones(20), scatter, correlation=0.8)) <= 0.1
    assert share(scattered(1 + 2 * np.exp(-NUMBER / 4), scatter)) <= 0.01


@pytest.mark.parametrize("depth", [0.1, 0.8])
def test_some_phases_of_a_beat_grow_until_the_run_is_longer_than_the_beat(depth):
    def beats(number, period):
        phases = np.linspace(0, 2 * np.pi, 60, endpoint=False)[:, None]
        return 1 + depth * np.sin(2 * np.pi * number / period + phases)

    assert all(share(beats(NUMBER, period)) == 0 for period in (3.3, 5, 8, 12))
    assert all(share(beats(LONG, period)) == 0 for period in (8, 12, 20, 30, 40, 60))
    assert 0.1 < share(beats(NUMBER, 40)) < 0.4


def test_saturation_levels_off_while_it_bends_and_is_steady_before_or_in_the_longer_run():
    for scatter, tau in ((0, 6), (0, 9), (0.005, 6), (0.005, 9)):
        assert share(scattered(saturation(NUMBER, tau), scatter, n=50), "levels_off") > 0.9
    for tau in (11, 30, 100):  # the end still grows
        assert growth(saturation(NUMBER, tau), SETTINGS)[3:] == (True, False)
    assert not any(growth(saturation(NUMBER, tau), SETTINGS).grows for tau in (1, 3, 5))
    assert not any(growth(saturation(LONG, tau), SETTINGS).grows for tau in (10, 20, 45))
    assert share(scattered(1.05**NUMBER, 0.1), "levels_off") <= 0.05  # growth that lasts, or quickens
    assert growth(np.exp(2e-3 * NUMBER**2), SETTINGS)[3:] == (True, False)


@pytest.mark.parametrize(
    ("amplitude", "status", "longer", "expected"),  # saturating, divergent, revolutions
    [
        (np.array([0.5, np.nan, np.nan]), "unbounded", None, (False, True, 2)),  # whatever the fit
        (saturation(NUMBER, 8), "completed", None, (True, False, 20)),
        (saturation(NUMBER, 20), "completed", None, (False, True, 20)),
        (saturation(NUMBER, 20), "completed", saturation(LONG, 20), (True, False, 60)),
        (1.03**NUMBER, "completed", 1.03**LONG, (False, True, 60)),
        (1.03**NUMBER, "completed", np.where(LONG < 42, 1.0, np.nan), (False, True, 42)),
        (1.03**NUMBER, "completed", np.where(LONG < 60, 1.0, np.nan), (False, True, 60)),
    ],
)
def test_the_longer_run_decides_and_leaving_all_bounds_is_divergence(amplitude, status, longer, expected):
    assert judge(amplitude, status, SETTINGS, longer)[1:4] == expected


def test_completed_runs_that_grow_need_confirmation_if_wanted():
    assert needs_confirmation(1.03**NUMBER, "completed", SETTINGS)
    assert needs_confirmation(saturation(NUMBER, 8), "completed", SETTINGS)
    assert not needs_confirmation(1.03**NUMBER, "unbounded", SETTINGS)
    assert not needs_confirmation(1.03**NUMBER, "completed", SETTINGS.replaced("confirmation_revolutions", 0))
    assert not needs_confirmation(1.03 ** np.arange(60), "completed", SETTINGS)  # as long as a longer run
