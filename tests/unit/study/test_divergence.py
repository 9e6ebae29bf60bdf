import numpy as np
import pytest

from bladerub.study import divergence
from bladerub.study.divergence import growth_per_revolution, is_divergent
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import write_map

NUMBER = np.arange(20)


@pytest.mark.parametrize("growth", [-0.05, 0.0, 0.03, 0.5])
def test_growth_of_an_exponential_is_found(growth):
    assert growth_per_revolution(1e-3 * (1 + growth) ** NUMBER, 10) == pytest.approx(growth, abs=1e-12)


def test_scatter_averages_out():
    rng = np.random.default_rng(5)
    peak = 1.03**NUMBER * (1 + 0.02 * rng.standard_normal(20))
    assert growth_per_revolution(peak, 20) == pytest.approx(0.03, abs=0.003)


def test_only_the_last_revolutions_are_fitted():
    peak = np.concatenate([2.0 ** np.arange(10), np.full(10, 500.0)])
    assert growth_per_revolution(peak, 10) == pytest.approx(0, abs=1e-12)


def test_a_run_that_ended_early_is_fitted_up_to_its_end():
    peak = 1.2 ** NUMBER.astype(float)
    peak[7:] = np.nan
    assert growth_per_revolution(peak, 10) == pytest.approx(0.2)


def test_a_blade_that_never_moved_does_not_grow():
    assert growth_per_revolution(np.zeros(20), 10) == 0.0


def test_one_revolution_has_no_growth():
    peak = np.full(20, np.nan)
    peak[0] = 1.0
    assert np.isnan(growth_per_revolution(peak, 10))


SETTINGS = {"revolutions": 10, "growth": 0.01}


def test_divergent_is_growth_above_the_threshold_or_leaving_all_bounds():
    assert is_divergent(1.011**NUMBER, "completed", SETTINGS)
    assert not is_divergent(1.009**NUMBER, "completed", SETTINGS)
    assert is_divergent(0.5**NUMBER, "unbounded", SETTINGS)
    assert is_divergent(np.array([1.0, np.nan]), "unbounded", SETTINGS)


def test_a_beat_past_its_maximum_does_not_diverge():
    rising_again = np.where(NUMBER < 10, 2.0, 1.03 ** (NUMBER - 10))
    assert growth_per_revolution(rising_again, 10) == pytest.approx(0.03)
    assert not is_divergent(rising_again, "completed", SETTINGS)


def test_the_table_has_a_row_per_run(tmp_path, config, make_map):
    cases = [CoatingCase("2nd", E, 0.5, 0.0) for E in (0.11, 2.0)]
    speeds = [0.1, 0.2, 0.3]
    paths = []
    for case, growth, status in zip(
        cases, (0.0, [0.0, 0.05, 0.002]), ("completed", ["completed", "completed", "unbounded"]), strict=True
    ):
        paths.append(tmp_path / f"{case.name}.h5")
        write_map(paths[-1], make_map(case, {}, speeds, lobes=[5, 6, 4], growth=growth, status=status))
    table = divergence.table(config, paths)
    assert list(table.columns) == divergence.COLUMNS
    assert list(table.E) == [0.11] * 3 + [2.0] * 3
    assert list(table.f_omega) == speeds * 2
    assert list(table.divergent) == [False] * 4 + [True, True]
    assert list(table.lobes) == [5, 6, 4] * 2
    assert list(table.status)[-2:] == ["completed", "unbounded"]
    np.testing.assert_allclose(table.growth_per_revolution, [0, 0, 0, 0, 0.05, 0.002], atol=1e-12)
