import numpy as np
import pytest

from bladerub.study import divergence
from bladerub.study.grid import CoatingCase


def test_the_table_has_a_row_per_run(config, make_map):
    cases = [CoatingCase("2nd", E, 0.5, 0.0) for E in (0.11, 2.0)]
    speeds = [0.1, 0.2, 0.3]
    maps = []
    for case, growth, status in zip(
        cases, (0.0, [0.0, 0.05, 0.002]), ("completed", ["completed", "completed", "unbounded"]), strict=True
    ):
        maps.append(make_map(case, {}, speeds, lobes=[5, 6, 4], growth=growth, status=status))
    table = divergence.table(config, maps)
    assert list(table.columns) == divergence.COLUMNS
    assert list(table.columns[:9]) == (
        ["casing", "E", "K", "theta", "f_omega", "growth_per_revolution", "saturating", "divergent", "lobes"]
    )
    assert list(table.E) == [0.11] * 3 + [2.0] * 3
    assert list(table.f_omega) == speeds * 2
    assert list(table.divergent) == [False] * 4 + [True, True]
    assert not table.saturating.any()
    assert list(table.lobes) == [5, 6, 4] * 2
    assert list(table.revolutions) == [20] * 6
    assert list(table.status)[-2:] == ["completed", "unbounded"]
    np.testing.assert_allclose(table.growth_per_revolution, [0, 0, 0, 0, 0.05, 0.002], atol=1e-12)
    assert (table.growth_low < table.growth_per_revolution).all()
    assert (table.growth_high > table.growth_per_revolution).all()


def test_a_longer_run_decides_where_there_is_one(config, make_map, case):
    longer = np.full((4, 60), np.nan)
    longer[0] = 1.03 ** np.arange(60)
    longer[1] = 1 - np.exp(-np.arange(1, 61) / 12)
    longer[2, :41] = 1.03 ** np.arange(41)
    speeds = [0.1, 0.2, 0.3, 0.4]
    coating = make_map(case, {}, speeds, growth=[0.03, 0.03, 0.03, 0.0], longer=longer)
    table = divergence.table(config, [coating])
    assert list(table.divergent) == [True, False, True, False]
    assert list(table.saturating) == [False, True, False, False]
    assert list(table.revolutions) == [60, 60, 41, 20]
    assert list(table.status) == ["completed", "completed", "unbounded", "completed"]
    assert table.growth_per_revolution[1] == pytest.approx(0, abs=2e-3)
