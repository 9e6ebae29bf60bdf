"""Brittleness: what is compressed elastically beyond the strain to break breaks off.

The plastic law as long as the elastic strain of what remains is below the strain to break. The part of an
element that is pressed further breaks off at the crushing force, so that the rest stays at that strain:
ploughing and micro-rupture in their simplest form, whose wear is the depth removed. A strain to break that is
never reached gives the plastic law.
"""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.law import elastic_force, stored_energy
from bladerub.contact.spec import Coating
from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum, where

PARAMETERS = {"break_strain": ("1", 1e-9, 1e9, "elastic strain at which an element breaks off")}

_SOFT = 1e-300  # N/m: hardening below this is none


class Element(NamedTuple):
    """Parameters of the law, each a float, an array or a vector."""

    elastic: np.ndarray  # Stiffness that belongs to E, N/m
    hardening: np.ndarray  # Stiffness that belongs to K, N/m
    yield_force: np.ndarray  # Elastic limit of the unworn element, N
    crushing_force: np.ndarray  # Force at the strain to break, N
    elastic_compliance: np.ndarray  # 1 / elastic, m/N
    plastic_compliance: np.ndarray  # 1 / (elastic + hardening), m/N
    hardening_compliance: np.ndarray  # 1 / hardening, m/N


def element(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> Element:
    """Return the parameters of elements of the cross-section `area`, m²; this law knows no `time_step`, s."""
    plastic = law.element(coating, area)
    strain = dict(coating.element_law.parameters)["break_strain"]
    return Element(
        **plastic._asdict(),
        crushing_force=plastic.elastic * strain * coating.thickness,
        hardening_compliance=1 / np.maximum(plastic.hardening, _SOFT),
    )


@elementwise
def return_mapping(element, depth, wear):
    """Find the compressive force of an element (N), and how much it flows and breaks off (m)."""
    trial = element.elastic * depth
    flow = element.plastic_compliance * maximum(trial - _hardened(element, wear), 0.0)
    broken = element.elastic_compliance * (trial - element.crushing_force)
    increment = maximum(flow, broken)
    return maximum(trial - element.elastic * increment, 0.0), increment


@elementwise
def _hardened(element, wear):
    """Force at which an element flows that does not break, N."""
    return element.yield_force + element.hardening * wear


@elementwise
def elastic_limit(element, wear):
    """Force at which a worn element flows or breaks, N."""
    return minimum(_hardened(element, wear), element.crushing_force)


@elementwise
def tangent(element, depth, wear):
    """Find the stiffness of an element (N/m), and a change of depth up to which it is constant (m)."""
    trial = element.elastic * depth
    excess = trial - _hardened(element, wear)
    flowing = excess > 0.0
    unbroken = trial - element.elastic * element.plastic_compliance * maximum(excess, 0.0)
    beyond = unbroken - element.crushing_force
    plastic = element.elastic * element.plastic_compliance * element.hardening
    slope = where(beyond > 0.0, 0.0, where(flowing, plastic, element.elastic))
    nearest = minimum(minimum(absolute(trial), absolute(excess)), absolute(beyond))
    return where(trial > 0.0, slope, 0.0), element.elastic_compliance * nearest


@elementwise
def dissipated_energy(element, wear, increment, force_before, force):
    """Energy that an element takes up as its wear grows from `wear` by `increment`, J."""
    limit = elastic_limit(element, wear)
    room = element.hardening_compliance * (element.crushing_force - limit)
    flow = minimum(increment, room)
    return (limit + 0.5 * element.hardening * flow) * flow + element.crushing_force * (increment - flow)
