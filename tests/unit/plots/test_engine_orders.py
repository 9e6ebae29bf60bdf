import pytest
from matplotlib.figure import Figure

from bladerub.plots import engine_orders


@pytest.mark.parametrize("over", ["speed", "frequency"])
def test_lines_have_slope_k_and_end_at_the_frame(over):
    axes = Figure().add_subplot()
    if over == "speed":
        engine_orders.draw(axes, {k: k for k in range(1, 9)}, 0.4, 2.0)
        lines = [line.get_xydata() for line in axes.lines]
    else:
        engine_orders.draw(axes, {k: 1 / k for k in range(1, 9)}, 2.0, 0.4)
        lines = [line.get_xydata()[:, ::-1] for line in axes.lines]
    for k, line in enumerate(lines, start=1):
        (x0, y0), (speed, f) = line
        assert (x0, y0) == (0, 0)
        assert f == pytest.approx(k * speed)
        assert speed == pytest.approx(0.4) or f == pytest.approx(2.0)
    assert [text.get_text() for text in axes.texts][:4] == ["eo(1)", "eo(2)", "eo(3)", "eo(4)"]
