"""Viscoplasticity: the stress beyond the elastic limit is proportional to the rate of the plastic strain.

Perzyna's law with linear overstress and linear hardening, ``σ − σ_Y − K ε_p = η dε_p/dt`` (Simo and Hughes
1998, section 1.7). At a low rate it is the plastic law, at a high one the element is elastic.

The flow of a step h is integrated exactly for a strain that changes linearly over it. It follows from the
rates r of ε_p at both ends, ``Δε_p = h (α r_n + (1 − α) r_{n−1})`` with ``α = 1/(1 − e^−ρ) − 1/ρ`` and
``ρ = h (E + K)/η``: at small ρ α is 1/2, at large ρ 1, and the flow that of the plastic law. The wear that an
element keeps has what is known of its next step already: ``ε_p + h (1 − α) r_n``.
"""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.law import elastic_limit, stored_energy
from bladerub.contact.spec import Coating
from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum, where

PARAMETERS = {
    "viscosity": ("Pa s", 0.0, 1e9, "stress beyond the elastic limit over the rate of the plastic strain"),
}

_AT_ONCE = 20.0  # ρ from which on the flow of a step ends within it: what is left is e^−ρ of the overstress


class Element(NamedTuple):
    """Parameters of the law, each a float, an array or a vector."""

    elastic: np.ndarray  # Stiffness that belongs to E, N/m
    hardening: np.ndarray  # Stiffness that belongs to K, N/m
    yield_force: np.ndarray  # Elastic limit of the unworn element, N
    elastic_compliance: np.ndarray  # 1 / elastic, m/N
    plastic_compliance: np.ndarray  # Wear of a step over the force beyond the limit, m/N
    weight: np.ndarray  # α
    ahead: np.ndarray  # Force of the wear that is kept ahead, over the force beyond the limit after it
    kept: np.ndarray  # Wear that is kept ahead over the force beyond the limit before it, m/N


def element(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> Element:
    """Return the parameters of elements of the cross-section `area` (m²) in steps of `time_step` (s)."""
    plastic = law.element(coating, area)
    stiffness = plastic.elastic + plastic.hardening
    viscous = dict(coating.element_law.parameters)["viscosity"] / time_step * area / coating.thickness
    with np.errstate(divide="ignore"):
        decay = np.divide(stiffness, viscous)  # ρ
    flows_on = decay < _AT_ONCE
    decay = np.clip(decay, 1e-3, _AT_ONCE)  # below, α is 1/2 to four digits
    weight = np.where(flows_on, -1 / np.expm1(-decay) - 1 / decay, 1.0)
    rest, resistance = 1 - weight, np.where(flows_on, viscous, 1.0)
    return Element(
        plastic.elastic,
        plastic.hardening,
        plastic.yield_force,
        plastic.elastic_compliance,
        1 / (weight * stiffness + viscous),
        weight,
        rest * plastic.elastic / (resistance - rest * stiffness),
        rest / (resistance - rest * plastic.hardening),
    )


@elementwise
def return_mapping(element, depth, wear):
    """Find the compressive force of an element (N) and how much it wears in a step (m).

    The plastic multiplier is ``Δγ = f / (α (E + K) + η/h)`` (Simo and Hughes 1998, section 1.7, with linear
    hardening, where α is 1), and the element has yielded by α of it at the end of the step.
    """
    trial = element.elastic * depth
    increment = element.plastic_compliance * maximum(trial - elastic_limit(element, wear), 0.0)
    return maximum(trial - element.weight * element.elastic * increment, 0.0), increment


@elementwise
def elastic_force(element, depth, wear):
    """Force of an element at a depth that it has borne before, N; it may have been flowing."""
    force = element.elastic * depth
    return maximum(force + element.ahead * maximum(force - elastic_limit(element, wear), 0.0), 0.0)


@elementwise
def tangent(element, depth, wear):
    """Find the stiffness of an element (N/m), and the change of depth up to which it is constant (m)."""
    trial = element.elastic * depth
    excess = trial - elastic_limit(element, wear)
    flowing = element.elastic * (1.0 - element.weight * element.elastic * element.plastic_compliance)
    stiffness = where(trial > 0.0, where(excess > 0.0, flowing, element.elastic), 0.0)
    return stiffness, element.elastic_compliance * minimum(absolute(trial), absolute(excess))


@elementwise
def dissipated_energy(element, wear, increment, force_before, force):
    """Energy that an element takes up in a step as its wear grows from `wear` by `increment`, J.

    It begins to flow at the elastic limit, or flows on from the step before.
    """
    limit = elastic_limit(element, wear)
    strain = element.kept * maximum(force_before - limit, 0.0) + element.weight * increment
    return 0.5 * (maximum(force_before, limit) + force) * strain
