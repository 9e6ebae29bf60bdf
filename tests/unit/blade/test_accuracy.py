import numpy as np
import pandas as pd
import pytest

from bladerub.blade.accuracy import ACCURACY_COLUMNS, accuracy_table, doubts
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


def of_errors(eq2, reduced):
    """Make a table of one mode of 100 Hz at rest, with these relative errors at the last speed but one."""
    f_omega = np.arange(5) / 10
    f_fe = 100 * (1 + f_omega)
    at = f_omega == 0.3
    table = pd.DataFrame({"f_omega": f_omega, "mode": 1, "f_fe": f_fe, "f_fe_eq2": f_fe * (1 + eq2 * at)})
    return table.assign(f_rom=f_fe * (1 + reduced * at), relative_error=reduced * at)


@pytest.mark.parametrize(
    ("table", "nominal", "doubt", "cure"),
    [
        (of_errors(0.009, 0.015), None, None, None),
        (of_errors(0.039, 0.04), 2400.0, "eq. (2) is up to 3.9 %", ": lower reduction.f_omega_max"),
        (of_errors(0.009, 0.009), 3000.0, "the nominal speed of 3000 1/min is f_omega = 0.5", ": raise that"),
    ],
)
def test_one_line_for_each_doubt(table, nominal, doubt, cure):
    lines = doubts(table, nominal)
    if doubt is None:
        assert lines == []
    else:
        (line,) = lines
        assert line.startswith(doubt)
        assert cure in line
