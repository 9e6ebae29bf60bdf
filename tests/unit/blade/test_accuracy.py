import numpy as np
import pytest

from bladerub.blade.accuracy import ACCURACY_COLUMNS, accuracy_table, reduced_frequencies
from bladerub.blade.model import ReducedBlade


@pytest.fixture
def oscillators():
    """Thirty uncoupled unit masses, the j-th of frequency j Hz at rest, all stiffened by 100 f_omega² N/m."""
    n = 30
    squares = (2 * np.pi * np.arange(1, n + 1)) ** 2
    return ReducedBlade(
        mass=np.eye(n),
        stiffness_0=np.diag(squares),
        stiffness_1=100 * np.eye(n),
        stiffness_2=np.zeros((n, n)),
        node_position=np.zeros((8, 3)),
        radial_direction=np.zeros((8, 3)),
        tangential_direction=np.zeros((8, 3)),
        f1_hz=1.0,
        f_omega_max=0.4,
        eta=2,
        rank_tolerance=1e-5,
        length=0.2,
    )


def test_reduced_frequencies_are_those_of_the_oscillators(oscillators):
    expected = np.sqrt(np.arange(1, 6) ** 2 + 100 * 0.3**2 / (2 * np.pi) ** 2)
    np.testing.assert_allclose(reduced_frequencies(oscillators, 0.3, 5), expected, rtol=1e-12)
    assert reduced_frequencies(oscillators, 0.0)[-1] == pytest.approx(30.0)


def test_table_has_a_row_for_each_speed_and_mode(oscillators):
    finite_element = {0.0: np.array([1.0, 2.0]), 0.4: np.array([1.1, 2.2])}
    by_law = {0.0: np.array([1.0, 2.0]), 0.4: np.array([1.2, 2.3])}
    table = accuracy_table(oscillators, finite_element, by_law)
    assert list(table.columns) == ACCURACY_COLUMNS
    assert table[["f_omega", "mode"]].to_numpy().tolist() == [[0.0, 1], [0.0, 2], [0.4, 1], [0.4, 2]]
    assert table.f_fe_eq2.tolist() == [1.0, 2.0, 1.2, 2.3]
    expected = reduced_frequencies(oscillators, 0.4, 2) / [1.1, 2.2] - 1
    np.testing.assert_allclose(table.relative_error, [0.0, 0.0, *expected], atol=1e-12)
