import numpy as np
import pandas as pd
import pytest
from mpl_toolkits.mplot3d import Axes3D

from bladerub.plots.histogram import peak_histogram

VALUES = np.array([[0.1, np.nan], [0.4, 0.3], [np.nan, 0.2]])
MM = pd.DataFrame(VALUES, index=[0.11, 1.1, 20], columns=[0.5, 5])


def draw(mm, quantity="amplitude", half=np.nan):
    """Draw the values over E (rows) and K (columns), as amplitudes in mm or as speeds, `half` a band."""
    rows = mm.rename_axis(index="E", columns="K").stack(future_stack=True).rename(quantity).reset_index()
    rows[quantity] *= 1e-3 if quantity == "amplitude" else 1
    ends = {f"{quantity}_low": rows[quantity] - half, f"{quantity}_high": rows[quantity] + half}
    rows = rows.assign(**ends)
    return peak_histogram(rows.assign(casing="2nd", theta=0.0, order=4), quantity, order=4, unit=600e6)[1]


def test_a_bar_for_each_value_and_none_for_a_hole(monkeypatch):
    bars = []
    monkeypatch.setattr(Axes3D, "bar3d", lambda self, *bar, **look: bars.append(bar))
    draw(MM, "f_peak")
    ((x, y, floor, width, depth, height),) = bars
    places = np.rint(np.transpose([x + width / 2, y + depth / 2])).astype(int)
    np.testing.assert_array_equal(places, [[0, 0], [1, 0], [1, 1], [2, 1]])
    np.testing.assert_allclose(floor + height, [0.1, 0.4, 0.3, 0.2])


@pytest.mark.parametrize(
    ("quantity", "half", "texts", "hatched"),
    [
        ("amplitude", 3.1e-5, {"0.10\n±0.03", "0.40\n±0.03", "0.30\n±0.03", "0.20\n±0.03"}, {0, 1, 2}),
        ("f_peak", 0.009, {"0.100\n±0.009", "0.400\n±0.009", "0.300\n±0.009", "0.200\n±0.009"}, set()),
    ],
)
def test_bands_stand_below_the_values_and_wide_ones_are_hatched(quantity, half, texts, hatched):
    cells = draw(MM, quantity, half).axes[1]
    assert {text.get_text() for text in cells.texts} == texts | {"–"}
    places = {patch.get_x() + 0.5 for patch in cells.patches if patch.get_hatch()}
    assert places == hatched


@pytest.mark.parametrize(("quantity", "floor"), [("f_peak", 0.292), ("amplitude", 0.0)])
def test_bars_and_colours_begin_at_the_floor(draws, quantity, floor):
    figure = draws(draw(0.3 + MM[1:] / 100, quantity))
    assert figure.axes[0].get_zlim()[0] == pytest.approx(floor)
    assert figure.axes[1].collections[0].norm.vmin == pytest.approx(floor)


PEAKS = pd.DataFrame(
    [
        ("2nd", 1.1, 0.5, 0.0, 4, 0.31, 2e-3),
        ("2nd", 0.11, 0.5, 0.0, 4, 0.30, 1e-3),
        ("2nd", 0.11, 5.0, 0.0, 4, 0.32, 3e-3),
        ("2nd", 1.1, 0.5, 0.0, 6, 0.2, 9e-3),
    ],
    columns=["casing", "E", "K", "theta", "order", "f_peak", "amplitude"],
).assign(**{f"{name}_{end}": np.nan for name in ("f_peak", "amplitude") for end in ("low", "high")})


def test_amplitudes_of_one_order_are_drawn_in_mm(draws):
    table, figure = peak_histogram(PEAKS, "amplitude", order=4, unit=600e6)
    ends = ["amplitude_low", "amplitude_high"]
    assert list(table.columns) == ["casing", "E", "K", "theta", "order", "amplitude", *ends]
    pd.testing.assert_frame_equal(table, PEAKS.loc[PEAKS.order == 4, table.columns])
    _, cells, _ = draws(figure).axes
    assert [text.get_text() for text in cells.texts] == ["1.00", "3.00", "2.00", "–"]
