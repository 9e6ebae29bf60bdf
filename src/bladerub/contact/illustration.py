"""The law of the coating and the profile of the tip without a blade, as Figs. 3 and 4 show them."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from bladerub.contact import law, tip
from bladerub.contact.spec import Coating, TipProfile


@dataclass(frozen=True)
class LoadingCycle:
    """One abradable element through a loading cycle (Fig. 4).

    Parameters
    ----------
    coating : Coating
        The law's moduli and yield stress.
    strain, stress, plastic_strain : (n,) ndarray
        Compressive, along the path; stress normalised.
    """

    coating: Coating
    strain: np.ndarray
    stress: np.ndarray
    plastic_strain: np.ndarray


def loading_cycle(coating: Coating, turning_points: Sequence[float], steps: int) -> LoadingCycle:
    """Compress an unworn element from one strain of `turning_points` to the next in `steps` each."""
    branches = [np.linspace(start, end, steps + 1)[1:] for start, end in pairwise(turning_points)]
    strain = np.concatenate([turning_points[:1], *branches])
    stress, wear = np.zeros(strain.size), np.zeros(strain.size)
    for step in range(1, strain.size):
        stress[step], wear[step] = law.load(coating, strain[step] * coating.thickness, wear[step - 1])
    return LoadingCycle(coating, strain, stress, wear / coating.thickness)


@dataclass(frozen=True)
class PressedElements:
    """Abradable elements under an interface node at one instant (Fig. 3).

    Parameters
    ----------
    coating : Coating
        Thickness and angle of the elements.
    width : float
        Of an element, m.
    element : (n,) ndarray of int
        Number of each element, from the one under the node.
    shortening, wear : (n,) ndarray
        Of the element, and the permanent part of it, m; what is above it is elastic.
    stress : (n,) ndarray
        Compressive, normalised.
    tip_offset, tip_depth : (m,) ndarray
        Profile of the tip: offset from the node in element widths, depth below the original surface, m.
    """

    coating: Coating
    width: float
    element: np.ndarray
    shortening: np.ndarray
    wear: np.ndarray
    stress: np.ndarray
    tip_offset: np.ndarray
    tip_depth: np.ndarray


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
    tip_offset = np.linspace(-1, 1, 81) * (profile.half_width + 0.5)
    tip_depth = depth - tip.relief(profile, tip_offset)
    width = 2 * np.pi * casing_radius / coating.n_elements
    shortening = np.maximum(penetration, wear)
    return PressedElements(coating, width, element, shortening, wear, stress, tip_offset, tip_depth)
