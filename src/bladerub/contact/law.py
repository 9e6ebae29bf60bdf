"""Law of an abradable element: one-dimensional plasticity with linear hardening (Fig. 4).

This module is all that the program knows of the law. The time loop calls it with eight interface nodes at a
time, its fallback with one, the reference model and Fig. 4 with arrays. Another law changes this file alone.
"""

from typing import NamedTuple

import numpy as np

from bladerub.contact.spec import Coating
from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum, where


class Element(NamedTuple):
    """Parameters of the law, each a float, an array or a vector.

    Parameters
    ----------
    elastic, hardening : N/m
        Stiffness that belongs to E and to K.
    yield_force : N
        Elastic limit of the unworn element, σ_Y times its area.
    elastic_compliance, plastic_compliance : m/N
        1 / elastic and 1 / (elastic + hardening).
    """

    elastic: np.ndarray
    hardening: np.ndarray
    yield_force: np.ndarray
    elastic_compliance: np.ndarray
    plastic_compliance: np.ndarray


def element(coating: Coating, area: float | np.ndarray) -> Element:
    """Return the parameters of elements of the cross-section `area`, m²."""
    stiffness = coating.modulus_unit * area / coating.thickness
    elastic, hardening = coating.E * stiffness, coating.K * stiffness
    yield_force = coating.yield_stress * coating.modulus_unit * area
    return Element(elastic, hardening, yield_force, 1 / elastic, 1 / (elastic + hardening))


@elementwise
def return_mapping(element, depth, wear):
    """Find the force of an element and how much it wears (Fig. 4).

    Parameters
    ----------
    element : Element
        Parameters of the law.
    depth : float
        Depth of the tip below the worn surface, m; negative above it.
    wear : float
        Permanent shortening before, m.

    Returns
    -------
    force : float
        Compressive force, 0 above the worn surface, N.
    increment : float
        Permanent shortening that is added, m.

    Notes
    -----
    An element only pushes, so the accumulated plastic strain is wear over thickness. The plastic multiplier
    is ``Δγ = f / (E + K)``; loading follows ``E_T = E K / (E + K)`` (Simo and Hughes 1998, box 1.4).
    """
    trial = element.elastic * depth
    increment = element.plastic_compliance * maximum(trial - elastic_limit(element, wear), 0.0)
    return maximum(trial - element.elastic * increment, 0.0), increment


@elementwise
def elastic_limit(element, wear):
    """Elastic limit of an element that is worn, N."""
    return element.yield_force + element.hardening * wear


@elementwise
def elastic_force(element, depth):
    """Force of an element at a depth that it has borne before, N."""
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
def dissipated_energy(element, wear, increment):
    """Energy that an element takes up as its wear grows from `wear` by `increment`, J."""
    return (elastic_limit(element, wear) + 0.5 * element.hardening * increment) * increment


def load(coating: Coating, penetration: np.ndarray, wear: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compress elements of the coating to `penetration`.

    Parameters
    ----------
    coating : Coating
        Moduli, elastic limit and thickness.
    penetration, wear : array_like
        Depth of the tip below the original surface and permanent shortening, m; broadcast together.

    Returns
    -------
    stress : ndarray
        Compressive stress, normalised by the coating's modulus unit.
    wear : ndarray
        Permanent shortening after it, m.
    """
    penetration, wear = np.asarray(penetration, dtype=float), np.asarray(wear, dtype=float)
    of_unit_force = element(coating, 1 / coating.modulus_unit)
    stress, increment = return_mapping(of_unit_force, penetration - wear, wear)
    return stress, wear + increment
