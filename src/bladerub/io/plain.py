"""Values as JSON takes them."""

import math
from typing import Any


def plain(value: Any) -> Any:
    """Return nested values with lists for arrays and tuples, and null for NaN and infinities, as JSON has."""
    if isinstance(value, dict):
        return {name: plain(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    if hasattr(value, "tolist"):  # an array, or a number, of NumPy
        return plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value
