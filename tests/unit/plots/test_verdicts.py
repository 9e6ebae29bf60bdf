import numpy as np
import pandas as pd

from bladerub.plots.verdicts import verdicts


def test_a_mark_for_each_verdict_and_none_where_there_is_none():
    said = {"study": ["yes", "no", np.nan], "stiff": ["yes", "partly", "yes"]}
    holds = pd.DataFrame(said, index=["C1a", "C2", "C3"])
    figure = verdicts(holds)
    (axes,) = figure.axes
    marks = {each.get_label(): {tuple(at) for at in each.get_offsets()} for each in axes.collections}
    assert marks == {"yes": {(0, 0), (1, 0), (1, 2)}, "partly": {(1, 1)}, "no": {(0, 1)}}
