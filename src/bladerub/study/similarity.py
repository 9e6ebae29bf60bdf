"""What makes the rub of another blade the same in proportion, so that the paper's E and K keep their meaning.

Lengths of the contact go with the length of the blade, the stiffness of an element of the coating with the
static stiffness of the tip, times with the period of the first mode. A blade that is the stand-in's in other
units then does the same in these units; for another one, E and K compare coating and blade as they do there.
"""

from __future__ import annotations

import numpy as np

from bladerub.blade.model import N_INTERFACE, ReducedBlade
from bladerub.contact.setup import strip_width

LENGTH = 0.2
"""Blade length, m, of the stand-in of config/config.yaml, which the values of the contact there are for."""
F1_HZ = 192.198910
"""First frequency of the stand-in at rest, Hz."""
TIP_STIFFNESS = 147967.472
"""`tip_stiffness` of the stand-in, N/m."""
TRACK_AREA = 0.0194115063
"""`track_area` of the stand-in, m²."""


def tip_stiffness(blade: ReducedBlade) -> float:
    """Evaluate the static stiffness of the tip at rest, N/m.

    The force is spread evenly over the interface nodes and points where they give way most on average: that
    is across the blade, whatever its stagger and flow path.
    """
    spread = np.zeros((len(blade.mass), 3))
    spread[: 3 * N_INTERFACE] = np.tile(np.eye(3), (N_INTERFACE, 1)) / N_INTERFACE
    compliance = spread.T @ np.linalg.solve(blade.stiffness_0, spread)
    return float(1 / np.linalg.eigvalsh(0.5 * (compliance + compliance.T))[-1])


def track_area(blade: ReducedBlade) -> float:
    """Evaluate the area of the coating that the mean interface node passes over in a revolution, m²."""
    radius = np.hypot(blade.node_position[:, 1], blade.node_position[:, 2])
    return float(np.mean(strip_width(blade) * 2 * np.pi * radius))


def contact_scale(blade: ReducedBlade) -> dict[str, float]:
    """Give ``contact.scale`` of the config, which makes the contact of the stand-in that of `blade`.

    Returns
    -------
    dict
        ``length``, ``modulus`` and ``time``: by what the lengths, the unit of the moduli and the largest
        time step are multiplied.
    """
    length = blade.length / LENGTH
    # E modulus_unit area / thickness is the stiffness of all elements of a track together
    stiffness = tip_stiffness(blade) / TIP_STIFFNESS
    return {
        "length": length,
        "modulus": stiffness * length * TRACK_AREA / track_area(blade),
        "time": F1_HZ / blade.f1_hz,
    }
