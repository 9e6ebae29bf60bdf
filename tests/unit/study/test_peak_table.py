import numpy as np

from bladerub.study.grid import CoatingCase
from bladerub.study.peak_table import table


def test_the_table_has_a_row_per_coating_and_order(config, make_map):
    maps = []
    for E, f_peak in ((0.11, 0.19), (1.1, 0.21)):
        case = CoatingCase("2nd", E, 0.5, 0.0)
        maps.append(make_map(case, {4: (0.31, E * 1e-4), 6: (f_peak, E * 2e-4)}))
    peaks = table(config, maps)
    assert list(peaks.columns) == ["casing", "E", "K", "theta", "order", "f_peak", "amplitude", "law"]
    assert list(peaks.E) == [0.11, 0.11, 1.1, 1.1]
    assert list(peaks.order) == [4, 6, 4, 6]
    np.testing.assert_allclose(peaks.f_peak, [0.31, 0.19, 0.31, 0.21])
    np.testing.assert_allclose(peaks.amplitude, [1.1e-5, 2.2e-5, 1.1e-4, 2.2e-4])
