import numpy as np
import pandas as pd
import pytest

from bladerub.extras.plots.robustness import robustness

FACTORS = ["unit", "lean"]


def drawn(total):
    table = pd.DataFrame(
        {
            "id": ["C1a", "C2a", "C10b"],
            "yes_share": [1.0, 0.5, np.nan],
            "partly_share": [0.0, 0.2, np.nan],
            "no_share": [0.0, 0.3, np.nan],
            "predicted": [np.nan, 0.4, np.nan],
        }
    )
    rows = [
        {"id": "C2a", "output": output, "factor": factor, "first": 0.0, "total": value, "predicted": 0.4}
        for output in ("verdict", "margin")
        for factor, value in zip(FACTORS, total, strict=True)
    ]
    return robustness(table, pd.DataFrame(rows))


def test_shares_add_up_and_stand_in_order():
    shares, *_ = drawn([0.3, 0.05]).axes
    widths = np.array([[bar.get_width() for bar in bars] for bars in shares.containers])
    assert widths[:, 1] == pytest.approx([50, 20, 30])
    assert [bars[1].get_x() for bars in shares.containers] == pytest.approx([0, 50, 70])
    assert [label.get_text() for label in shares.get_yticklabels()] == ["C1a", "C2a", "C10b"]


@pytest.mark.parametrize(("total", "top"), [([0.3, 0.05], 0.3), ([0.02, 0.01], 0.1)])
def test_indices_fill_the_rows_of_what_varies(total, top):
    figure = drawn(total)
    factors = figure.axes[1]
    (image,) = factors.collections
    values = np.ma.filled(image.get_array().astype(float), np.nan)
    assert values[1] == pytest.approx(total)
    assert np.isnan(values[[0, 2]]).all()
    assert image.get_clim() == (0, top)
    written = {text.get_text() for text in factors.texts}
    assert ("0.3" in written) == (top == 0.3)
    assert "0.40" in written
