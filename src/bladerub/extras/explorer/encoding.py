"""Numbers for pictures, made small, and text that is safe inside a page.

What the small numbers lose is below what a picture shows. Numbers that a reader may quote are not among them.
"""

import base64
import gzip
import json
from typing import Any

import numpy as np

from bladerub.io.plain import plain

_ESCAPES = str.maketrans({"<": "\\u003c", ">": "\\u003e", "&": "\\u0026"})


def linear_steps(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Write each row of `values` (n, m), not negative, in steps of 1/255 of its greatest value (n,)."""
    greatest = values.max(axis=1)
    share = values / np.where(greatest > 0, greatest, 1.0)[:, None]
    return np.rint(255 * share).astype(np.uint8), greatest


def logarithmic_steps(values: np.ndarray, low: float, high: float, dtype: type) -> np.ndarray:
    """Write `values` in equal ratios from `low` to `high`, both positive, as unsigned integers `dtype`.

    Step 1 stands for `low` and below, the greatest step for `high` and above, 0 for NaN.
    """
    top = np.iinfo(dtype).max
    share = np.log(np.clip(values, low, high) / low) / np.log(high / low)
    return np.where(np.isnan(values), 0, 1 + np.rint((top - 1) * np.nan_to_num(share))).astype(dtype)


def differences(steps: np.ndarray) -> np.ndarray:
    """Differences (n, m) of `steps` (n, m) along each row, modulo 256: smooth rows compress better so."""
    return np.diff(steps, axis=1, prepend=np.uint8(0))


def log_range(values: np.ndarray, floor: float) -> tuple[float, float]:
    """Find the ends of a logarithmic scale that holds all `values` above `floor`, which is positive.

    The upper is twice the lower at least; the lower is `floor` if there is no such value.
    """
    visible = values[values > floor]
    if visible.size == 0:
        return floor, 2 * floor
    return float(visible.min()), float(max(visible.max(), 2 * visible.min()))


def packed(data: bytes) -> str:
    """Compress `data` (gzip) and write it as text (base64); equal data give equal text."""
    return base64.b64encode(gzip.compress(data, compresslevel=9, mtime=0)).decode("ascii")


def json_text(value: Any) -> str:
    """Write `value` as JSON that a script element can hold: nothing in it ends the element or begins another.

    Arrays become lists; NaN and infinities, which JSON lacks, become null. Numbers keep all their digits.
    """
    return json.dumps(plain(value), allow_nan=False, separators=(",", ":")).translate(_ESCAPES)
