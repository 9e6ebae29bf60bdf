import numpy as np
import pandas as pd
import pytest

from bladerub.extras.variations.figures import robustness
from bladerub.extras.variations.verdicts import verdicts

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


def test_shares_add_up_in_order_and_indices_fill_the_rows_of_what_varies():
    shares, factors, *_ = drawn([0.3, 0.05]).axes
    widths = np.array([[bar.get_width() for bar in bars] for bars in shares.containers])
    assert widths[:, 1] == pytest.approx([50, 20, 30])
    assert [bars[1].get_x() for bars in shares.containers] == pytest.approx([0, 50, 70])
    (image,) = factors.collections
    values = np.ma.filled(image.get_array().astype(float), np.nan)
    assert values[1] == pytest.approx([0.3, 0.05])
    assert np.isnan(values[[0, 2]]).all()


def test_a_mark_for_each_verdict_and_none_where_there_is_none():
    said = {"study": ["yes", "no", np.nan], "stiff": ["yes", "partly", "yes"]}
    (axes,) = verdicts(pd.DataFrame(said, index=["C1a", "C2", "C3"])).axes
    marks = {each.get_label(): {tuple(at) for at in each.get_offsets()} for each in axes.collections}
    assert marks == {"yes": {(0, 0), (1, 0), (1, 2)}, "partly": {(1, 1)}, "no": {(0, 1)}}
    assert axes.yaxis_inverted()
