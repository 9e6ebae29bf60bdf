import json

import numpy as np
import pytest

from bladerub.explorer.inert import json_text


@pytest.mark.parametrize(
    "name", ["</script><script>alert(1)</script>", "<!--<script>", "a & b", "\u2028\u2029", "\\u003c", "\"'`"]
)
def test_a_hostile_name_stays_a_name(name):
    text = json_text({name: [name]})
    assert json.loads(text) == {name: [name]}
    assert not set("<>&\u2028\u2029") & set(text)


def test_arrays_and_what_json_lacks():
    value = {"a": np.array([1.0, np.nan]), "b": np.float64(np.inf), "c": (np.int64(3), True, None)}
    assert json.loads(json_text(value)) == {"a": [1.0, None], "b": None, "c": [3, True, None]}


def test_numbers_keep_all_digits():
    number = 0.1 + 0.2
    assert json.loads(json_text([number])) == [number]
