"""Numbers for pictures, made small: coded in one or two bytes, compressed, and written as text.

What these codes lose is below what a picture shows. Numbers that a reader may quote do not pass through here.
"""

from __future__ import annotations

import base64
import gzip

import numpy as np


def linear(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Code each row of `values` in steps of 1/255 of its greatest value.

    Parameters
    ----------
    values : (n, m) ndarray
        Not negative.

    Returns
    -------
    codes : (n, m) ndarray of uint8
        ``codes / 255 * greatest`` are the values, to half a step.
    greatest : (n,) ndarray
    """
    greatest = values.max(axis=1)
    steps = values / np.where(greatest > 0, greatest, 1.0)[:, None]
    return np.rint(255 * steps).astype(np.uint8), greatest


def differences(codes: np.ndarray) -> np.ndarray:
    """Differences (n, m) of `codes` (n, m) along each row, modulo 256: smooth rows compress better so."""
    return np.diff(codes, axis=1, prepend=np.uint8(0))


def logarithmic(values: np.ndarray, low: float, high: float, dtype: type) -> np.ndarray:
    """Code `values` in equal ratios from `low` to `high`.

    Parameters
    ----------
    values : ndarray
        Values beyond the ends are coded as the ends, NaN as 0.
    low, high : float
        Positive, `high` the greater.
    dtype : type
        Unsigned integer; the greatest code c stands for `high`, 1 for `low`.

    Returns
    -------
    ndarray of `dtype`
        ``low * (high / low) ** ((codes - 1) / (c - 1))`` are the values, to half a ratio.
    """
    top = np.iinfo(dtype).max
    share = np.log(np.clip(values, low, high) / low) / np.log(high / low)
    return np.where(np.isnan(values), 0, 1 + np.rint((top - 1) * np.nan_to_num(share))).astype(dtype)


def log_range(values: np.ndarray, floor: float) -> tuple[float, float]:
    """Find the ends of a logarithmic scale that holds all `values` above `floor`, which is positive.

    The upper is twice the lower at least; the lower is `floor` if there is no such value.
    """
    shown = values[values > floor]
    if shown.size == 0:
        return floor, 2 * floor
    return float(shown.min()), float(max(shown.max(), 2 * shown.min()))


def packed(data: bytes) -> str:
    """Compress `data` (gzip) and write it as text (base64); equal data give equal text."""
    return base64.b64encode(gzip.compress(data, compresslevel=9, mtime=0)).decode("ascii")
