import numpy as np
import pandas as pd
from mpl_toolkits.mplot3d import Axes3D

from bladerub.plots.histogram import peak_histogram

PEAKS = pd.DataFrame(
    [
        ("2nd", 1.1, 0.5, 0.0, 4, 0.31, 2e-3),
        ("2nd", 0.11, 0.5, 0.0, 4, 0.30, 1e-3),
        ("2nd", 0.11, 5.0, 0.0, 4, 0.32, 3e-3),
        ("2nd", 1.1, 0.5, 0.0, 6, 0.2, 9e-3),
    ],
    columns=["casing", "E", "K", "theta", "order", "f_peak", "amplitude"],
)


def test_amplitudes_of_one_order_are_bars_and_cells_in_mm_and_holes_are_none(draws, monkeypatch):
    bars = []
    monkeypatch.setattr(Axes3D, "bar3d", lambda self, *bar, **look: bars.append(bar))
    table, figure = peak_histogram(PEAKS, "amplitude", order=4, unit=600e6)
    pd.testing.assert_frame_equal(table, PEAKS[PEAKS.order == 4].drop(columns="f_peak"))
    ((x, y, floor, width, depth, height),) = bars
    places = np.rint(np.transpose([x + width / 2, y + depth / 2])).astype(int)
    np.testing.assert_array_equal(places, [[0, 0], [0, 1], [1, 0]])
    np.testing.assert_allclose(floor + height, [1.0, 3.0, 2.0])
    _, cells, _ = draws(figure).axes
    assert [text.get_text() for text in cells.texts] == ["1.00", "3.00", "2.00", "–"]
