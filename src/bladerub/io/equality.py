"""Equality of objects that hold arrays, which `dataclass` itself cannot compare."""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np


class Comparable:
    """Base of a ``dataclass(eq=False)`` that equals another of its class if all fields are equal.

    NaN equals NaN: it stands for the same missing number. Objects that can be equal without being the same
    have no hash.
    """

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(
            equal(getattr(self, field.name), getattr(other, field.name)) for field in fields(self)
        )


def equal(a: Any, b: Any) -> bool:
    """Compare numbers, text, arrays, mappings, sequences and dataclasses of these, NaN being equal to NaN."""
    if isinstance(a, np.ndarray | np.generic | float) or isinstance(b, np.ndarray):
        a, b = np.asarray(a), np.asarray(b)
        return np.array_equal(a, b, equal_nan=a.dtype.kind in "fc" and b.dtype.kind in "fc")
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(equal(value, b[name]) for name, value in a.items())
    if isinstance(a, Sequence) and not isinstance(a, str) and type(a) is type(b):
        return len(a) == len(b) and all(map(equal, a, b))
    return a == b
