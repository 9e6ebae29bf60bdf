import pandas as pd

from bladerub.extras.cost.figure import cost


def test_bars_are_minutes_and_megabytes():
    stages = pd.DataFrame(
        {"jobs": [1, 57], "cpu_s": [60.0, 540.0], "share": [0.1, 0.9], "memory_mb": [480.0, 190.0]},
        index=pd.Index(["blade", "rubs"], name="stage"),
    )
    time, memory = cost(stages).axes
    assert [bar.get_width() for bar in time.patches] == [1.0, 9.0]
    assert [bar.get_width() for bar in memory.patches] == [480.0, 190.0]
