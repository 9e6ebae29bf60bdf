"""Similarity: the contact of another blade scaled so that the paper's E and K keep their meaning.

Lengths of the contact scale with the length of the blade, the stiffness of a coating element with the static
stiffness of the tip, times with the period of the first mode. A blade that is the stand-in in other units
then behaves the same in these units; for another one, E and K compare coating and blade as they do there.
"""

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.strips import strip_width

# The stand-in of config/config.yaml, which the values of the contact there are for
LENGTH = 0.2  # m
F1_HZ = 192.198910  # at rest
TIP_STIFFNESS = 147967.472  # N/m
TRACK_AREA = 0.0194115063  # m²


def tip_stiffness(blade: ReducedBlade) -> float:
    """Evaluate the static stiffness of the tip at rest, N/m, under a force spread evenly over its nodes.

    It is along the direction in which they are most compliant on average: across the blade, at any stagger.
    """
    spread = np.zeros((len(blade.mass), 3))
    n = blade.n_interface
    spread[: 3 * n] = np.tile(np.eye(3), (n, 1)) / n
    compliance = spread.T @ np.linalg.solve(blade.stiffness_0, spread)
    return float(1 / np.linalg.eigvalsh(0.5 * (compliance + compliance.T))[-1])


def track_area(blade: ReducedBlade) -> float:
    """Evaluate the area of the coating that the mean interface node passes over in a revolution, m²."""
    radius = np.hypot(blade.node_position[:, 1], blade.node_position[:, 2])
    return float(np.mean(strip_width(blade) * 2 * np.pi * radius))


def contact_scale(blade: ReducedBlade) -> dict[str, float]:
    """Return ``contact.scale`` of the config, which scales the contact of the stand-in to `blade`."""
    length = blade.length / LENGTH
    # E modulus_unit area / thickness is the stiffness of all elements of a track together
    stiffness = tip_stiffness(blade) / TIP_STIFFNESS
    modulus = stiffness * length * TRACK_AREA / track_area(blade)
    return {"length": length, "modulus": modulus, "time": F1_HZ / blade.f1_hz}
