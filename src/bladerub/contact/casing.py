"""Inner shape of the distorted casing and the gap it leaves (Fig. 5)."""

from functools import lru_cache

import numpy as np

from bladerub.contact.spec import Casing


@lru_cache
def _largest_sum(nodal_diameters: tuple[int, ...], weights: tuple[float, ...]) -> float:
    angle = np.linspace(0, 2 * np.pi, 72_001)
    return float(np.max(np.cos(np.outer(angle, nodal_diameters)) @ weights))


def shape(casing: Casing, angle: np.ndarray) -> np.ndarray:
    """Inward displacement at `angle` (rad) over the amplitude: ``Σ w_n cos(n φ)`` divided by its maximum."""
    terms = np.cos(np.multiply.outer(np.asarray(angle), casing.nodal_diameters))
    return terms @ np.asarray(casing.weights) / _largest_sum(casing.nodal_diameters, casing.weights)


def gap(casing: Casing, clearance: float | np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Gap g₀ of eq. (8) at `angle` (rad), ``c_j + (a − δ) − a s(φ)``, m.

    It is negative where tip and coating overlap. `clearance` is that of the node, c_j (m), broadcast against
    `angle`.
    """
    offset = casing.amplitude - casing.interference
    return clearance + offset - casing.amplitude * shape(casing, angle)
