"""What makes the frequencies of a reduced blade doubtful."""

import numpy as np
import pandas as pd
import pytest

from bladerub.blade.frequencies import doubts


def of_errors(eq2, reduced):
    """Make a table of one mode of 100 Hz at rest, with these relative errors at the last speed but one."""
    f_omega = np.arange(5) / 10
    f_fe, at = 100 * (1 + f_omega), f_omega == 0.3
    table = {"f_omega": f_omega, "mode": 1, "f_fe": f_fe, "f_fe_eq2": f_fe * (1 + eq2 * at)}
    return pd.DataFrame({**table, "f_rom": f_fe * (1 + reduced * at), "relative_error": reduced * at})


@pytest.mark.parametrize(
    ("table", "nominal", "doubt", "cure"),
    [
        (of_errors(0.009, 0.015), None, None, None),
        (of_errors(0.039, 0.04), 2400.0, "eq. (2) is up to 3.9 %", ": lower reduction.f_omega_max"),
        (of_errors(0.009, 0.009), 3000.0, "the nominal speed of 3000 1/min is f_omega = 0.5", ": raise that"),
    ],
)
def test_one_line_for_each_doubt(table, nominal, doubt, cure):
    lines = doubts(table, nominal)
    assert len(lines) == (doubt is not None)
    assert all(line.startswith(doubt) and cure in line for line in lines)
