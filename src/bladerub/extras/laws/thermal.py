"""Thermal softening: friction and flow heat the surface, and a warm element is softer and weaker.

The plastic law, all of whose forces fall with the temperature by the factor of Johnson and Cook (1983),
``1 − (T / T_m)^m`` with T the rise and T_m that at which nothing is left. The bar is a column of the layer:
`bladerub.extras.laws.heating` lets its heat flow to the casing and puts the factors of its parts in series.
"""

import numpy as np

from bladerub.contact.law import (
    Element,
    dissipated_energy,
    elastic_force,
    elastic_limit,
    element,
    return_mapping,
    stored_energy,
    tangent,
)
from bladerub.contact.spec import Coating
from bladerub.extras.laws.heating import Layer

PARAMETERS = {
    "heat_capacity": ("J/(m3 K)", 1e3, 1e8, "heat that a volume of the coating takes"),
    "conductivity": ("W/(m K)", 0.0, 1e9, "thermal conductivity of the coating"),
    "heated_depth": ("m", 1e-6, 1e-2, "depth below the surface in which friction and flow make heat"),
    "friction_share": ("1", 0.0, 1.0, "part of the heat of friction that goes into the coating"),
    "softening_rise": ("K", 1.0, 1e12, "rise of temperature at which the coating has lost its strength"),
    "softening_exponent": ("1", 0.1, 10.0, "exponent of the loss of strength with the rise"),
}

_LEAST = 0.01  # strength that is left beyond the rise at which it would be lost: forces stay defined


def strength(coating: Coating, rise: np.ndarray) -> np.ndarray:
    """Return the forces at a temperature that is higher by `rise` (K, an array), over those without heat."""
    parameters = dict(coating.element_law.parameters)
    loss = (np.maximum(rise, 0.0) / parameters["softening_rise"]) ** parameters["softening_exponent"]
    return np.maximum(1.0 - loss, _LEAST)
