import numpy as np
import pytest

from bladerub.extras.explorer.coating import LAST_ORDER, MOST_ANGLES, arc_means, arcs, kept_orders


@pytest.mark.parametrize(("n_elements", "n_arcs"), [(2000, MOST_ANGLES), (1999, MOST_ANGLES), (60, 60)])
def test_arcs_share_the_circumference(n_elements, n_arcs):
    bounds = arcs(n_elements)
    lengths = np.diff(bounds)
    assert (bounds[0], bounds[-1], lengths.size) == (0, n_elements, n_arcs)
    assert lengths.max() - lengths.min() <= 1


def test_means_are_those_of_the_elements_of_each_arc():
    values = np.random.default_rng(1).random((2, 1999))
    bounds = arcs(1999)
    means = arc_means(values, bounds)
    assert means[1, 7] == pytest.approx(values[1, bounds[7] : bounds[8]].mean())
    np.testing.assert_allclose((means * np.diff(bounds)).sum(axis=1), values.sum(axis=1))


def test_orders_are_kept_up_to_the_end_of_the_figures():
    order, f_omega = np.arange(601) / 10, np.array([0.02, 0.1, 0.4])
    kept = kept_orders(f_omega, order, max_frequency=2.5)
    ends = order[kept - 1]
    assert ends[0] == 60  # all there are
    assert 25 <= ends[1] <= 25.2
    assert LAST_ORDER <= ends[2] <= LAST_ORDER + 0.2
