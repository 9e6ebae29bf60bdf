import numba
import numpy as np
import pytest
from numba.core.errors import NumbaError

from bladerub.numerics.machine_code import innermost


def test_the_innermost_of_what_the_compiler_repeats_for_each_caller_is_told():
    inner = numba.njit(lambda x: np.vander(x) + x.missing)
    outer = numba.njit(lambda x: inner(x) + 1.0)
    with pytest.raises(NumbaError) as refused:
        outer(1.0)
    assert "outer" not in innermost(refused.value)
    assert innermost(refused.value).endswith('test_machine_code.py", line 10')
