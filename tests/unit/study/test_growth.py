"""The definition of divergence on made-up amplitudes of 20 and 60 revolutions, and its limits.

What 20 revolutions can show, from the last 10 of them at a threshold of 1 % and a confidence of 95 %, found
here on made-up amplitudes; real runs scatter by 0.1 to 20 % between revolutions:

- A steady run passes for growing in at most 1 case of 100, whatever the scatter, and in 7 where
  neighbouring revolutions are correlated by 0.8.
- Growth of 3 % is found whenever the scatter is below 2 %, in 9 cases of 10 at 5 % and in 3 of 10 at 10 %.
- Saturation as ``1 - exp(-i / τ)`` is distinguished from growth for τ of 6 to 9 revolutions; faster ones are
  steady by then. From τ = 11 on the growth at the end is still surely above 1 %, and the run passes for
  divergent. A scatter of 2 % hides the bend in half of the cases.
- A beat with a period above 20 revolutions passes for growing in up to 4 of 10 phases, and so does a
  slow onset that wear will end. Both are what the longer run is for: with 60 revolutions, saturation is
  found up to τ = 45 and no beat with a period up to 60 passes.
"""

import numpy as np
import pytest

from bladerub.study.growth import growth, judge, needs_confirmation

SETTINGS = {"revolutions": 10, "growth": 0.01, "confidence": 0.95, "confirmation_revolutions": 60}
NUMBER = np.arange(1.0, 21.0)
LONG = np.arange(1.0, 61.0)


def saturation(number, tau):
    return 1 - np.exp(-number / tau)


def scattered(amplitude, scatter, correlation=0.0, n=300, seed=3):
    """The amplitude n times, its logarithm with normal scatter that neighbouring revolutions may share."""
    noise = np.random.default_rng(seed).standard_normal((n, amplitude.size))
    for i in range(1, amplitude.size):
        noise[:, i] = correlation * noise[:, i - 1] + np.sqrt(1 - correlation**2) * noise[:, i]
    return amplitude * np.exp(scatter * noise)


def share(runs, attribute="grows"):
    return np.mean([getattr(growth(run, SETTINGS), attribute) for run in runs])


class TestGrowthRate:
    @pytest.mark.parametrize("rate", [-0.05, 0.0, 0.03, 0.5])
    def test_of_an_exponential_is_found(self, rate):
        found = growth(1e-3 * (1 + rate) ** NUMBER, SETTINGS)
        assert found.per_revolution == pytest.approx(rate, abs=1e-12)
        assert found.low == pytest.approx(rate, abs=4e-4)  # however exact the fit, not better than this
        assert found.low < rate < found.high

    def test_is_that_of_the_last_revolutions(self):
        amplitude = np.concatenate([2.0 ** np.arange(10), np.full(10, 500.0)])
        assert growth(amplitude, SETTINGS).per_revolution == pytest.approx(0, abs=1e-12)

    @pytest.mark.parametrize("scatter", [0.01, 0.1])
    def test_lies_in_its_interval_as_often_as_the_confidence_says(self, scatter):
        found = [growth(run, SETTINGS) for run in scattered(1.03**NUMBER, scatter, n=1000)]
        inside = np.mean([each.low < 0.03 < each.high for each in found])
        assert inside == pytest.approx(0.95, abs=0.02)

    def test_is_nothing_for_a_blade_that_never_moved(self):
        found = growth(np.zeros(20), SETTINGS)
        assert (found.per_revolution, found.low, found.high, found.grows) == (0, 0, 0, False)

    @pytest.mark.parametrize(("begun", "measured"), [(1, "none"), (2, "rate"), (3, "interval")])
    def test_of_few_revolutions_has_no_interval_and_of_fewer_no_value(self, begun, measured):
        amplitude = np.full(20, np.nan)
        amplitude[:begun] = 1.5 ** np.arange(begun)
        found = growth(amplitude, SETTINGS)
        assert np.isfinite(found.per_revolution) == (measured != "none")
        assert np.isfinite(found.low) == np.isfinite(found.high) == (measured == "interval")
        assert found.grows == (measured == "interval")
        assert not found.levels_off


class TestGrows:
    def test_above_the_threshold_alone(self):
        assert growth(1.011**NUMBER, SETTINGS).grows
        assert not growth(1.009**NUMBER, SETTINGS).grows
        assert not growth(0.97**NUMBER, SETTINGS).grows

    @pytest.mark.parametrize(("scatter", "least"), [(0.02, 1.0), (0.05, 0.8), (0.1, 0.2)])
    def test_through_the_scatter_of_real_runs(self, scatter, least):
        assert share(scattered(1.03**NUMBER, scatter)) >= least

    @pytest.mark.parametrize("scatter", [0.001, 0.05, 0.2])
    def test_not_when_steady_or_decaying(self, scatter):
        assert share(scattered(np.ones(20), scatter)) <= 0.02
        assert share(scattered(np.ones(20), scatter, correlation=0.8)) <= 0.1
        assert share(scattered(1 + 2 * np.exp(-NUMBER / 4), scatter)) <= 0.01
        assert share(scattered(0.97**NUMBER, scatter)) == 0

    def test_not_after_a_greater_amplitude(self):
        rising_again = np.where(NUMBER <= 10, 2.0, 1.03 ** (NUMBER - 10))
        assert growth(rising_again, SETTINGS).low > 0.01
        assert not growth(rising_again, SETTINGS).grows

    @pytest.mark.parametrize(("greatest", "grows"), [(1.104, False), (1.105, True)])
    def test_when_greater_than_before_by_ten_revolutions_of_threshold_growth(self, greatest, grows):
        amplitude = np.r_[np.ones(10), greatest * 1.03 ** np.arange(-9, 1)]  # 1.01 ** 10 is 1.1046
        assert growth(amplitude, SETTINGS).grows == grows

    @pytest.mark.parametrize("depth", [0.1, 0.3, 0.8])
    def test_for_some_phases_of_beats_until_the_run_is_longer_than_they_are(self, depth):
        def beats(number, period):
            phases = np.linspace(0, 2 * np.pi, 60, endpoint=False)[:, None]
            return 1 + depth * np.sin(2 * np.pi * number / period + phases)

        assert all(share(beats(NUMBER, period)) == 0 for period in (3.3, 5, 8, 12))
        assert all(share(beats(LONG, period)) == 0 for period in (8, 12, 20, 30, 40, 60))
        assert 0.1 < share(beats(NUMBER, 40)) < 0.4


class TestLevelsOff:
    @pytest.mark.parametrize("scatter", [0, 0.001, 0.005])
    def test_on_saturation(self, scatter):
        for tau in (6, 7, 8, 9):
            assert share(scattered(saturation(NUMBER, tau), scatter, n=50), "levels_off") > 0.9

    def test_not_while_the_end_still_grows(self):
        for tau in (11, 15, 30, 100):
            found = growth(saturation(NUMBER, tau), SETTINGS)
            assert (found.grows, found.levels_off) == (True, False)

    @pytest.mark.parametrize("scatter", [0, 0.01, 0.1])
    def test_not_on_exponential_growth(self, scatter):
        assert share(scattered(1.05**NUMBER, scatter), "levels_off") <= 0.05

    def test_not_on_growth_that_quickens(self):
        found = growth(np.exp(2e-3 * NUMBER**2), SETTINGS)
        assert (found.grows, found.levels_off) == (True, False)

    def test_fast_saturation_is_steady_by_then_and_slow_saturation_in_the_longer_run(self):
        assert not any(growth(saturation(NUMBER, tau), SETTINGS).grows for tau in (1, 2, 3, 5))
        assert not any(growth(saturation(LONG, tau), SETTINGS).grows for tau in (10, 20, 30, 45))


class TestVerdict:
    def test_leaving_all_bounds_is_divergence_whatever_the_fit(self):
        for amplitude in (0.5**NUMBER, np.array([1.0, np.nan, np.nan])):
            verdict = judge(amplitude, "unbounded", SETTINGS)
            assert (verdict.divergent, verdict.saturating, verdict.status) == (True, False, "unbounded")
        assert verdict.revolutions == 1

    def test_the_longer_run_decides(self):
        slow = judge(saturation(NUMBER, 20), "completed", SETTINGS)
        assert (slow.divergent, slow.saturating) == (True, False)
        slow = judge(saturation(NUMBER, 20), "completed", SETTINGS, saturation(LONG, 20))
        assert (slow.divergent, slow.saturating, slow.revolutions) == (False, True, 60)
        lasting = judge(1.03**NUMBER, "completed", SETTINGS, 1.03**LONG)
        assert (lasting.divergent, lasting.saturating, lasting.revolutions) == (True, False, 60)


def test_completed_runs_that_grow_need_confirmation_if_wanted():
    assert needs_confirmation(1.03**NUMBER, "completed", SETTINGS)
    assert needs_confirmation(saturation(NUMBER, 8), "completed", SETTINGS)
    assert not needs_confirmation(np.ones(20), "completed", SETTINGS)
    assert not needs_confirmation(1.03**NUMBER, "unbounded", SETTINGS)
    assert not needs_confirmation(1.03**NUMBER, "completed", SETTINGS | {"confirmation_revolutions": 0})
    assert not needs_confirmation(1.03 ** np.arange(60), "completed", SETTINGS)  # as long as a longer run
