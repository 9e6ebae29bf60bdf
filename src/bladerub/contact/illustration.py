"""The law of the coating and the profile of the tip without a blade, as Figs. 3 and 4 show them."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from bladerub.contact import law, tip
from bladerub.contact.laws import module_of
from bladerub.contact.spec import Coating, TipProfile


class LoadingCycle(NamedTuple):
    """One abradable element through a loading cycle (Fig. 4); all compressive, (n,) along the path."""

    coating: Coating
    strain: np.ndarray
    stress: np.ndarray  # Normalised
    plastic_strain: np.ndarray


def loading_cycle(
    coating: Coating, turning_points: Sequence[float], steps: int, rate: float = 0.0, rise: float = 0.0
) -> LoadingCycle:
    """Compress an unworn element from one strain of `turning_points` to the next in `steps` each.

    `rate` is that of the strain (1/s), `rise` that of the temperature (K), for laws in which they count.
    """
    law = module_of(coating.element_law)
    branches = [np.linspace(start, end, steps + 1)[1:] for start, end in pairwise(turning_points)]
    strain = np.concatenate([turning_points[:1], *branches])
    stress, wear = np.zeros(strain.size), np.zeros(strain.size)
    for step in range(1, strain.size):
        time_step = abs(strain[step] - strain[step - 1]) / rate if rate else math.inf
        element = law.element(coating, 1 / coating.modulus_unit, time_step)
        depth = strain[step] * coating.thickness - wear[step - 1]
        stress[step], increment = law.return_mapping(element, depth, wear[step - 1])
        wear[step] = wear[step - 1] + increment
    if rise:
        stress *= law.strength(coating, rise)
    return LoadingCycle(coating, strain, stress, wear / coating.thickness)


class PressedElements(NamedTuple):
    """Abradable elements under an interface node at one instant (Fig. 3)."""

    coating: Coating
    width: float  # Of an element, m
    element: np.ndarray  # (n,): Number of each element, from the one under the node
    shortening: np.ndarray  # (n,): Of each element, m
    wear: np.ndarray  # (n,): The permanent part of it, m; the rest is elastic
    stress: np.ndarray  # (n,): Compressive, normalised
    tip_offset: np.ndarray  # (m,): Points of the profile of the tip, from the node, element widths
    tip_depth: np.ndarray  # (m,): Their depth below the original surface, m


def pressed_elements(
    coating: Coating, profile: TipProfile, casing_radius: float, depth: float, reach: int
) -> PressedElements:
    """Let the tip pass over unworn elements and stop above the middle one of ``2 reach + 1``.

    Its node is at `depth` (m) below their original surface, the casing of radius `casing_radius` (m).
    """
    element = np.arange(-reach, reach + 1)
    wear = np.zeros(element.size)
    for node in np.linspace(-2 * reach, 0, 40 * reach + 1):
        offset = element - node
        penetration = np.maximum(depth - tip.relief(profile, offset), 0)
        penetration[tip.coverage(profile, offset) == 0] = 0
        stress, wear = law.load(coating, penetration, wear)
    tip_offset = np.linspace(-1, 1, 81) * tip.edge(profile)
    tip_depth = depth - tip.relief(profile, tip_offset)
    width = 2 * np.pi * casing_radius / coating.n_elements
    shortening = np.maximum(penetration, wear)
    return PressedElements(coating, width, element, shortening, wear, stress, tip_offset, tip_depth)
