"""Text that stays text inside a page, whatever it holds."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

_ESCAPES = str.maketrans({"<": "\\u003c", ">": "\\u003e", "&": "\\u0026"})


def json_text(value: Any) -> str:
    """Write `value` as JSON that a script element can hold: nothing in it ends the element or begins another.

    Arrays become lists; NaN and infinities, which JSON lacks, become null. Numbers keep all their digits.
    """
    return json.dumps(_plain(value), allow_nan=False, separators=(",", ":")).translate(_ESCAPES)


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
