import pandas as pd
import pytest

from bladerub.extras.cost.figure import cost


@pytest.fixture
def stages():
    return pd.DataFrame(
        {"jobs": [1, 57], "cpu_s": [60.0, 540.0], "share": [0.1, 0.9], "memory_mb": [480.0, 190.0]},
        index=pd.Index(["blade", "rubs"], name="stage"),
    )


def test_bars_are_minutes_and_megabytes(stages):
    time, memory = cost(stages).axes
    assert [bar.get_width() for bar in time.patches] == [1.0, 9.0]
    assert [bar.get_width() for bar in memory.patches] == [480.0, 190.0]
    assert [label.get_text() for label in time.get_yticklabels()] == ["blade", "rubs"]
    assert {text.get_text() for text in time.texts} == {"10.0%, 1 job", "90.0%, 57 jobs"}
    assert time.yaxis_inverted()
    assert time.get_xlim() == pytest.approx((0, 1.45 * 9))  # with room for the words
    assert memory.get_xlim() == pytest.approx((0, 1.2 * 480))
