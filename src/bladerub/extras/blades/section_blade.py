"""The shape of a blade through sections: smooth along the span, straight through the thickness."""

from itertools import pairwise

import numpy as np
from scipy.interpolate import CubicSpline

from bladerub.extras.blades import origin, section_table
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.section_profile import SAMPLES, Profile, profile
from bladerub.extras.blades.section_table import Section
from bladerub.extras.blades.settings import Source

WIDEST = 50.0  # largest chord over length: beyond, they are not in the same unit
THINNEST = 0.005  # least thickness over chord of a section: below, angles are not in their unit


class SectionShape:
    """A blade as a map from the unit cube: chordwise ξ, through the thickness η, spanwise ζ.

    Root and tip are the first and the last section. Axial position, radius and angle are cubic splines of the
    span (a parabola through three sections, a straight line through two) and straight in η, so that a point
    between two sections or sides is on the surface of revolution between theirs.
    """

    def __init__(self, profiles: list[Profile]):
        radius = np.array([profile.radius for profile in profiles])
        self.span = (radius - radius[0]) / (radius[-1] - radius[0])  # (n,), ascending from 0 to 1
        self.samples = np.stack([profile.samples for profile in profiles])  # (n, 201, 2, 3)

    def points(self, xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray) -> np.ndarray:
        """Map the unit cube to space, as `bladerub.blade.geometry.BladeShape.points` does."""
        xi, eta, zeta = np.broadcast_arrays(xi, eta, zeta)
        stations, station = np.unique(xi, return_inverse=True)
        heights, height = np.unique(zeta, return_inverse=True)
        lattice = CubicSpline(self.span, CubicSpline(SAMPLES, self.samples, axis=1)(stations))(heights)
        sides = np.moveaxis(lattice[height, station], (-2, -1), (0, 1))
        x, radius, phi = (1 - eta) * sides[0] + eta * sides[1]
        return np.stack([x, radius * np.sin(phi), radius * np.cos(phi)])


def read_profiles(source: Source) -> list[Profile]:
    """Read the sections of the table that `source` names as profiles that a blade can have, hub to tip."""
    frame = origin.frame(source)
    sections = section_table.read(origin.path(source), frame, source.angle_unit or "rad")
    _check_units(sections, frame)
    profiles = [profile(section, frame.downstream_x) for section in sections]
    _check_thickness(profiles)
    _check_order(profiles)
    return profiles


def _check_units(sections: list[Section], frame: Frame) -> None:
    """Check the lengths of the sections against each other."""
    hub, tip = (np.hypot(*section.points[..., 1:].T).mean() for section in (sections[0], sections[-1]))
    length = abs(tip - hub)
    frame.check_length(length)
    for section in sections:
        chord = np.linalg.norm(np.ptp(section.points.mean(axis=0)[[0, -1]], axis=0))
        if chord > WIDEST * length:
            raise ValueError(
                f"section {section.name} (line {section.lines[0]}): its chord of {chord:.4g} m is more than "
                f"{WIDEST:g} times the length of the blade, {length:.4g} m; all lengths must be in one unit"
            )


def _check_thickness(profiles: list[Profile]) -> None:
    """Check that no section is a film, which takes hours to reduce."""
    for section in profiles:
        if section.thickness < THINNEST * section.chord:
            raise ValueError(
                f"section {section.name} is {1e3 * section.thickness:.2g} mm thick over a chord of "
                f"{1e3 * section.chord:.3g} mm; must be {THINNEST:.1%} of it or more: are angles and lengths "
                "in their units (blade.source.angle_unit)?"
            )


def _check_order(profiles: list[Profile]) -> None:
    """Check that each section lies above the one before."""
    for below, above in pairwise(profiles):
        if above.radius <= below.radius:
            raise ValueError(
                f"section {above.name}: its mean radius of {above.radius:.4g} m is not above that of section "
                f"{below.name} before it, {below.radius:.4g} m; sections must go from hub to tip"
            )
        gap = above.samples[..., 1] - below.samples[..., 1]
        if gap.min() <= 0:
            share = SAMPLES[np.argmin(gap.min(axis=1))]
            raise ValueError(
                f"sections {below.name} and {above.name} cross: {above.name} is not the farther from the "
                f"engine axis at {share:.0%} of the chord"
            )
