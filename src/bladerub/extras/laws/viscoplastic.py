"""Viscoplasticity: the stress beyond the elastic limit is proportional to the rate of the plastic strain.

Perzyna's law with linear overstress and linear hardening, ``σ − σ_Y − K ε_p = η dε_p/dt`` (Simo and Hughes
1998, section 1.7). At a low rate it is the plastic law, at a high one the element is elastic. The rate over
a step is taken as constant, and the overstress as it is at the end of the step (backward Euler): the
viscosity over the step acts as hardening that is forgotten at the end of the step.
"""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.law import elastic_force, elastic_limit, stored_energy
from bladerub.contact.spec import Coating
from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum, where

__all__ = ["elastic_force", "elastic_limit", "stored_energy"]

PARAMETERS = {
    "viscosity": ("Pa s", 0.0, 1e9, "stress beyond the elastic limit over the rate of the plastic strain"),
}


class Element(NamedTuple):
    """Parameters of the law, each a float, an array or a vector."""

    elastic: np.ndarray  # Stiffness that belongs to E, N/m
    hardening: np.ndarray  # Stiffness that belongs to K, N/m
    yield_force: np.ndarray  # Elastic limit of the unworn element, N
    viscous: np.ndarray  # Viscosity times area, over thickness and time step, N/m
    elastic_compliance: np.ndarray  # 1 / elastic, m/N
    plastic_compliance: np.ndarray  # 1 / (elastic + hardening + viscous), m/N


def element(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> Element:
    """Return the parameters of elements of the cross-section `area` (m²) in steps of `time_step` (s)."""
    plastic = law.element(coating, area)
    viscous = dict(coating.element_law.parameters)["viscosity"] / time_step * area / coating.thickness
    return Element(
        plastic.elastic,
        plastic.hardening,
        plastic.yield_force,
        viscous,
        plastic.elastic_compliance,
        1 / (plastic.elastic + plastic.hardening + viscous),
    )


@elementwise
def return_mapping(element, depth, wear):
    """Find the compressive force of an element (N) and how much it wears in a step (m).

    The plastic multiplier is ``Δγ = f / (E + K + η/Δt)`` (Simo and Hughes 1998, section 1.7, with linear
    hardening).
    """
    trial = element.elastic * depth
    increment = element.plastic_compliance * maximum(trial - elastic_limit(element, wear), 0.0)
    return maximum(trial - element.elastic * increment, 0.0), increment


@elementwise
def tangent(element, depth, wear):
    """Find the stiffness of an element (N/m), and the change of depth up to which it is constant (m)."""
    trial = element.elastic * depth
    excess = trial - elastic_limit(element, wear)
    flowing = element.elastic * element.plastic_compliance * (element.hardening + element.viscous)
    stiffness = where(trial > 0.0, where(excess > 0.0, flowing, element.elastic), 0.0)
    return stiffness, element.elastic_compliance * minimum(absolute(trial), absolute(excess))


@elementwise
def dissipated_energy(element, wear, increment, force_before, force):
    """Energy that an element takes up as its wear grows from `wear` by `increment`, J.

    It begins to flow at the elastic limit, or flows on from the step before.
    """
    return 0.5 * (maximum(force_before, elastic_limit(element, wear)) + force) * increment
