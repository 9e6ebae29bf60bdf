import numpy as np

from bladerub.blade.accuracy import ACCURACY_COLUMNS, accuracy_table
from bladerub.blade.frequencies import reduced_frequencies


def test_table_has_a_row_for_each_speed_and_mode(oscillators):
    finite_element = {0.0: np.array([1.0, 2.0]), 0.4: np.array([1.1, 2.2])}
    by_law = {0.0: np.array([1.0, 2.0]), 0.4: np.array([1.2, 2.3])}
    table = accuracy_table(oscillators, finite_element, by_law)
    assert list(table.columns) == ACCURACY_COLUMNS
    assert table[["f_omega", "mode"]].to_numpy().tolist() == [[0.0, 1], [0.0, 2], [0.4, 1], [0.4, 2]]
    assert table.f_fe_eq2.tolist() == [1.0, 2.0, 1.2, 2.3]
    expected = reduced_frequencies(oscillators, 0.4, 2) / [1.1, 2.2] - 1
    np.testing.assert_allclose(table.relative_error, [0.0, 0.0, *expected], atol=1e-12)
