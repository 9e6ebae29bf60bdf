"""Nested values that hold arrays: equality, which `dataclass` cannot tell of them, and as JSON takes them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any


class Comparable:
    """Base of a ``dataclass(eq=False)`` that equals another of its class if all fields are equal.

    NaN equals NaN: it stands for the same missing number. What can be equal and not the same has no hash.
    """

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(
            equal(getattr(self, field.name), getattr(other, field.name)) for field in fields(self)
        )


def equal(a: Any, b: Any) -> bool:
    """Compare numbers, text, arrays, mappings, sequences and dataclasses of these, NaN being equal to NaN."""
    import numpy as np  # commands write `plain` values, and start without it

    if isinstance(a, np.ndarray | np.generic | float) or isinstance(b, np.ndarray):
        a, b = np.asarray(a), np.asarray(b)
        return np.array_equal(a, b, equal_nan=a.dtype.kind in "fc" and b.dtype.kind in "fc")
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(equal(value, b[name]) for name, value in a.items())
    if isinstance(a, Sequence) and not isinstance(a, str) and type(a) is type(b):
        return len(a) == len(b) and all(map(equal, a, b))
    return a == b


def plain(value: Any) -> Any:
    """Return nested values with lists for arrays and tuples, and null for NaN and infinities, as JSON has."""
    if isinstance(value, dict):
        return {name: plain(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    if hasattr(value, "tolist"):  # an array, or a number, of NumPy
        return plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value
