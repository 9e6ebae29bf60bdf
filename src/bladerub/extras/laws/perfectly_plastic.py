"""Perfect plasticity: an element yields at a given stress, which wear does not change.

The plastic law without hardening, ``K = 0``, and with an elastic limit of its own; the K of a coating has no
effect.
"""

import math
from dataclasses import replace

import numpy as np

from bladerub.contact import law
from bladerub.contact.law import (
    Element,
    dissipated_energy,
    elastic_force,
    elastic_limit,
    return_mapping,
    stored_energy,
    tangent,
)
from bladerub.contact.spec import Coating

PARAMETERS = {"yield_stress": ("Pa", 1e3, 1e12, "stress at which an element yields")}


def element(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> Element:
    """Return the parameters of elements of the cross-section `area`, m²; this law knows no `time_step`, s."""
    limit = dict(coating.element_law.parameters)["yield_stress"]
    return law.element(replace(coating, K=0.0, yield_stress=limit / coating.modulus_unit), area)
