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
