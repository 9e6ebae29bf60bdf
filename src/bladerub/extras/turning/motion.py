"""The tilt of a profile that turns with the blade tip, and how the coating resists it.

At ``offset`` elements from its node a profile comes closer to the casing by ``tilt * offset``. The tilt (m
per element) is the slope of the tip against the casing under the displaced node: that of the blade's surface,
and the angle by which the node has moved along the curved casing. A turn of the whole blade about the axis so
leaves the gap as it is. The forces of the elements act on the blade with their couple as well, the sum of
``offset`` times force, which does work on the tilt.
"""

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import at_tip, tip_radii
from bladerub.contact.spec import RunSpec, TipProfile
from bladerub.contact.tip import edge


def further(blade: ReducedBlade, coordinates: np.ndarray, spec: RunSpec) -> np.ndarray:
    """Tilt (j, k) of the tip's profile against the casing for reduced coordinates (n, k), m per element.

    Raises `ValueError` if the blade does not say how its tip turns.
    """
    if blade.tip_slope is None:
        raise ValueError(
            "contact.tip_turns = true: this blade has no tip_slope; build it again with a finer mesh "
            "(blade.mesh.chordwise), or, if it is given by matrices, list more nodes of its tip, or set it "
            "to false"
        )
    _, tangential = np.split(at_tip(blade, coordinates), 2)
    radius, curvature_radius = tip_radii(blade)
    width = 2 * np.pi * radius / spec.coating.n_elements  # of an element
    return width[:, None] * (blade.tip_slope @ coordinates + tangential / curvature_radius[:, None])


def stiffness(element: np.ndarray, profile: TipProfile) -> np.ndarray:
    """Largest stiffness against the tilt of each node (j,), N per tilt, from that of an element, N/m."""
    return element * (2 / 3) * edge(profile) ** 3
