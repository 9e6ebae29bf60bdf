"""Law of an abradable element: one-dimensional plasticity with linear hardening (Fig. 4).

This module is all that the program knows of the law. The time loop calls it with eight interface nodes at a
time, its fallback with one, the reference model and Fig. 4 with arrays. Another law is another module with
the same functions, which ``docs/laws.md`` lists (`bladerub.contact.laws`).
"""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact.spec import Coating
from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum, where


class Element(NamedTuple):
    """Parameters of the law, each a float, an array or a vector."""

    elastic: np.ndarray  # Stiffness that belongs to E, N/m
    hardening: np.ndarray  # Stiffness that belongs to K, N/m
    yield_force: np.ndarray  # Elastic limit of the unworn element, σ_Y times its area, N
    elastic_compliance: np.ndarray  # 1 / elastic, m/N
    plastic_compliance: np.ndarray  # 1 / (elastic + hardening), m/N


def element(coating: Coating, area: float | np.ndarray, time_step: float = math.inf) -> Element:
    """Return the parameters of elements of the cross-section `area`, m²; this law knows no `time_step`, s."""
    stiffness = coating.modulus_unit * area / coating.thickness
    elastic, hardening = coating.E * stiffness, coating.K * stiffness
    yield_force = coating.yield_stress * coating.modulus_unit * area
    return Element(elastic, hardening, yield_force, 1 / elastic, 1 / (elastic + hardening))


@elementwise
def return_mapping(element, depth, wear):
    """Find the compressive force of an element (N) and how much it wears (m), Fig. 4.

    `depth` is that of the tip below the worn surface (m, negative above it), `wear` the permanent shortening
    before (m). An element only pushes, so the accumulated plastic strain is wear over thickness. The plastic
    multiplier is ``Δγ = f / (E + K)``; loading follows ``E_T = E K / (E + K)`` (Simo and Hughes 1998, box
    1.4).
    """
    trial = element.elastic * depth
    increment = element.plastic_compliance * maximum(trial - elastic_limit(element, wear), 0.0)
    return maximum(trial - element.elastic * increment, 0.0), increment


@elementwise
def elastic_limit(element, wear):
    """Elastic limit of an element that is worn, N."""
    return element.yield_force + element.hardening * wear


@elementwise
def elastic_force(element, depth, wear):
    """Force of an element at a depth that it has borne before, N; this law does without its `wear`, m."""
    return element.elastic * maximum(depth, 0.0)


@elementwise
def tangent(element, depth, wear):
    """Find the stiffness of an element (N/m), and the change of depth up to which it is constant (m)."""
    trial = element.elastic * depth
    excess = trial - elastic_limit(element, wear)
    plastic = element.elastic * element.plastic_compliance * element.hardening  # E_T
    stiffness = where(trial > 0.0, where(excess > 0.0, plastic, element.elastic), 0.0)
    return stiffness, element.elastic_compliance * minimum(absolute(trial), absolute(excess))


@elementwise
def stored_energy(element, force):
    """Elastic energy of an element under `force`, J."""
    return 0.5 * element.elastic_compliance * (force * force)


@elementwise
def dissipated_energy(element, wear, increment, force_before, force):
    """Energy that an element takes up as its wear grows from `wear` by `increment`, J.

    Its force goes from `force_before` to `force` (N), which this law does without.
    """
    return (elastic_limit(element, wear) + 0.5 * element.hardening * increment) * increment


def load(coating: Coating, penetration: np.ndarray, wear: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compress worn elements to `penetration`, the depth of the tip below the original surface (m).

    Returns the compressive stress, normalised, and the permanent shortening after it (m).
    """
    penetration, wear = np.asarray(penetration, dtype=float), np.asarray(wear, dtype=float)
    of_unit_force = element(coating, 1 / coating.modulus_unit)
    stress, increment = return_mapping(of_unit_force, penetration - wear, wear)
    return stress, wear + increment
