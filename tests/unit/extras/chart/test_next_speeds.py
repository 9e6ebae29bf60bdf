import numpy as np

from bladerub.extras.chart.search import next_speeds


def search(curve, step, share):
    """Run a search on a curve that is known everywhere: which speeds it looks at."""
    known = np.zeros(curve.size, dtype=bool)
    known[::step] = True
    while new := next_speeds(known, [np.where(known, curve, np.nan)], share):
        assert not known[new].any()
        known[new] = True
    return known


def test_a_smooth_maximum_is_enclosed_by_its_neighbours():
    curve = -np.abs(np.arange(65) - 21.0) + 100
    known = search(curve, 8, share=1.0)
    assert known[20:23].all()
    assert known.sum() <= 9 + 7


def test_a_lower_maximum_is_looked_at_only_from_the_share_on():
    place = np.arange(65)
    hidden = 50 + 60.0 * (place == 47) + 20 * np.clip(1 - np.abs(place - 48) / 4, 0, None)  # 70 at its sample
    curve = np.where(place > 40, hidden, 100 - 2 * np.abs(place - 16.0))
    assert not search(curve, 8, share=0.9)[47]
    assert search(curve, 8, share=0.6)[47]


def test_maxima_at_an_end_and_on_level_ground_are_enclosed():
    assert search(np.arange(17.0), 4, share=1.0)[14:].all()
    assert search(np.ones(9), 4, share=1.0).all()


def test_nothing_is_sought_where_nothing_is_known():
    known = np.array([True, False, True])
    assert next_speeds(known, [np.full(3, np.nan)], 0.5) == []
    assert next_speeds(known, [], 0.5) == []
