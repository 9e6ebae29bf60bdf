"""A coating that becomes denser as it is worn: its plastic modulus grows in proportion to the wear."""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.law import elastic_force, stored_energy
from bladerub.contact.spec import Coating
from bladerub.numerics.vectors import elementwise, maximum, sqrt, where

__all__ = ["elastic_force", "stored_energy"]

PARAMETERS = {
    "doubling": ("m", 1e-7, 1.0, "wear at which the plastic modulus is twice that of the unworn coating"),
}


class Element(NamedTuple):
    """Parameters of the law, each a float, an array or a vector."""

    elastic: np.ndarray  # Stiffness that belongs to E, N/m
    hardening: np.ndarray  # Stiffness that belongs to K of the unworn element, N/m
    densification: np.ndarray  # Change of that with the wear, N/m²
    yield_force: np.ndarray  # Elastic limit of the unworn element, N
    elastic_compliance: np.ndarray  # 1 / elastic, m/N


def element(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> Element:
    """Return the parameters of elements of the cross-section `area`, m²; this law knows no `time_step`, s."""
    plain = law.element(coating, area)
    doubling = dict(coating.element_law.parameters)["doubling"]
    densification = plain.hardening / doubling
    return Element(plain.elastic, plain.hardening, densification, plain.yield_force, plain.elastic_compliance)


@elementwise
def _excess(element, depth, wear):
    """Elastic force beyond the elastic limit, N."""
    limit = element.yield_force + (element.hardening + 0.5 * element.densification * wear) * wear
    return maximum(element.elastic * depth - limit, 0.0)


@elementwise
def return_mapping(element, depth, wear):
    """Find the compressive force of an element (N), and how much it wears (m): the root of a square."""
    excess = _excess(element, depth, wear)
    slope = element.elastic + element.hardening + element.densification * wear
    increment = 2.0 * excess / (slope + sqrt(slope * slope + 2.0 * element.densification * excess))
    return maximum(element.elastic * (depth - increment), 0.0), increment


@elementwise
def tangent(element, depth, wear):
    """Find the stiffness of an element (N/m), and the change of depth up to which it is constant (m)."""
    _, increment = return_mapping(element, depth, wear)
    flowing = element.hardening + element.densification * (wear + increment)
    plastic = element.elastic * flowing / (element.elastic + flowing)
    stiffness = where(increment > 0.0, plastic, element.elastic)
    return where(depth > 0.0, stiffness, 0.0), 0.0 * depth  # it is nowhere constant while it flows


@elementwise
def dissipated_energy(element, wear, increment, force_before, force):
    """Energy that an element takes up as its wear grows from `wear` by `increment`, J."""
    limit = element.yield_force + (element.hardening + 0.5 * element.densification * wear) * wear
    slope = element.hardening + element.densification * wear
    return (limit + (0.5 * slope + element.densification * increment / 6.0) * increment) * increment
