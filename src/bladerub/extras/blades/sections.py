"""Sections of a table as profiles without too thin edges, and the shape of the blade through them."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, PPoly
from scipy.spatial import cKDTree

from bladerub.extras.blades import origin, section_table
from bladerub.extras.blades.origin import Frame
from bladerub.extras.blades.profile import arc_length, camber_line, crossings
from bladerub.extras.blades.section_table import Section
from bladerub.extras.blades.settings import Source

WIDEST = 50.0  # largest chord over length: beyond, they are not in the same unit
THINNEST = 0.005  # least thickness over chord of a section: below, angles are not in their unit
EDGE_SHARE = 0.1  # of the largest thickness, below which an edge is cut off, to leave room for hexahedra
SAMPLES = np.linspace(0, 1, 201)  # of a profile, by relative arc length of the camber line
_CORNER = np.deg2rad(60)  # a side that turns more at a station has a corner there, else it is smooth
_FINE = 400  # points of a curve, or some more
_LAST_OF_EDGE = 0.25  # of the side; a corner further on is none of a blunt edge
_CUTS = 0.5 * np.linspace(0, 1, 201) ** 2  # of the camber line, where its thickness is looked at


class Profile(NamedTuple):
    """A section that can be meshed.

    `samples` are axial position (m), radius (m) and angle ``atan2(y, z)`` (rad) in the blade's frame, at
    `SAMPLES`, on the two sides. The angle of the second side is larger, or, where x points upstream, smaller,
    so that elements are right-handed.
    """

    name: str
    samples: np.ndarray  # (201, 2, 3)
    radius: float  # mean, m
    chord: float  # length of the camber line, m
    thickness: float  # largest, m
    cut: tuple[float, float]  # chord cut off at the leading and at the trailing edge, m


def profile(section: Section, downstream_x: int) -> Profile:
    """Make the profile of `section`; a ValueError names it and a line of its table."""
    place, flat = _cylindrical(section)
    if _must_be_swapped(section, flat, downstream_x):
        place, flat = place[::-1], flat[::-1]
    sides = [_Curve(*side) for side in zip(place, flat, strict=True)]
    thickness = cKDTree(sides[1].fine).query(sides[0].fine)[0].max()
    starts, cut_leading = _edge(sides, thickness, section.name)
    backwards = [_Curve(*side) for side in zip(place[:, ::-1], flat[:, ::-1], strict=True)]
    stops, cut_trailing = _edge(backwards, thickness, section.name)
    samples, chord = _paired(sides, starts, stops)
    radius = float(samples[:, :, 1].mean())
    return Profile(section.name, samples, radius, chord, float(thickness), (cut_leading, cut_trailing))


def _cylindrical(section: Section) -> tuple[np.ndarray, np.ndarray]:
    """Axial position, radius and angle of one turn (2, n, 3) of stations; x and arc length (2, n, 2)."""
    x, y, z = np.moveaxis(section.points, -1, 0)
    radius = np.hypot(y, z)
    if radius.min() <= 0:
        line = section.lines[np.argmin(radius.min(axis=0))]
        raise ValueError(f"line {line}: lies on the engine axis, which must pass through the origin")
    middle = np.arctan2(y.mean(), z.mean())
    cos, sin = np.cos(middle), np.sin(middle)
    phi = middle + np.arctan2(y * cos - z * sin, z * cos + y * sin)
    return np.stack([x, radius, phi], axis=-1), np.stack([x, radius * (phi - phi.mean())], axis=-1)


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _must_be_swapped(section: Section, flat: np.ndarray, downstream_x: int) -> bool:
    """Check that stations follow the chord and sides are apart; return whether the sides must be swapped."""
    middle = flat.mean(axis=0)
    chord = middle[-1] - middle[0]
    length = np.linalg.norm(chord)
    steps = np.diff(middle, axis=0) @ chord
    if length == 0 or (steps <= 0).any():
        before, line = section.lines[np.argmin(steps) :][:2]
        fault = f"this station of section {section.name} is no further along the chord than that of line"
        rule = "they must go from the leading to the trailing edge, each section once, under its own name"
        raise ValueError(f"line {line}: {fault} {before}; {rule}")
    if downstream_x * chord[0] < -1e-3 * length:
        label = f"section {section.name} (line {section.lines[0]})"
        rule = "must begin at the leading edge, or blade.source.downstream has the wrong sign"
        raise ValueError(f"{label}: its first station lies downstream of its last; {rule}")
    thickness = _cross(np.gradient(middle, axis=0), flat[1] - flat[0])
    sign = 1 if thickness.sum() > 0 else -1
    bad = sign * thickness < -1e-9 * np.abs(thickness).max()
    bad[1:-1] |= thickness[1:-1] == 0
    if bad.any():
        fault = f"the sides of section {section.name} touch or cross here"
        rule = "they may meet at its first and last station only"
        raise ValueError(f"line {section.lines[np.argmax(bad)]}: {fault}; {rule}")
    return sign < 0


class _Curve:
    """One side as a curve through its stations, smooth except at corners.

    Its parameter is the length of the polygon through the stations, m: `knots` at the stations. `place` of it
    (n, 5) is axial position, radius and angle, then the first and the arc length, unrolled. `corners` are
    stations where it turns sharply, `fine` are many unrolled points of the curve, at `fine_parameter`.
    """

    def __init__(self, place: np.ndarray, flat: np.ndarray):
        apart = np.append(True, np.linalg.norm(np.diff(flat, axis=0), axis=1) > 0)
        place, flat = place[apart], flat[apart]
        self.knots = arc_length(flat)
        chords = np.diff(flat, axis=0)
        turn = np.arctan2(np.abs(_cross(chords[:-1], chords[1:])), np.sum(chords[:-1] * chords[1:], axis=1))
        self.corners = 1 + np.flatnonzero(turn > _CORNER)
        last = len(flat) - 1
        both = np.hstack([place, flat])
        pieces = [slice(start, stop + 1) for start, stop in pairwise([0, *self.corners, last])]
        splines = [CubicSpline(self.knots[piece], both[piece]) for piece in pieces]
        self.place = PPoly(np.concatenate([spline.c for spline in splines], axis=1), self.knots)
        fine = np.linspace(0, last, -(-_FINE // last) * last + 1)
        self.fine_parameter = np.interp(fine, np.arange(last + 1), self.knots)
        self.fine = self.place(self.fine_parameter)[:, 3:]


def _edge(sides: list[_Curve], thickness: float, name: str) -> tuple[list[float], float]:
    """Find a leading edge that is wide enough: parameters of both sides behind it, and the chord cut off."""
    min_thickness = EDGE_SHARE * thickness
    first, second = (side.fine[0] for side in sides)
    chord = sides[0].fine[-1] + sides[1].fine[-1] - first - second
    chord /= np.linalg.norm(chord)
    if abs(_cross(second - first, chord)) >= min_thickness:  # as it is
        return [0.0, 0.0], 0.0
    for index, side in enumerate(sides):
        corners = side.knots[side.corners]
        corners = corners[corners < _LAST_OF_EDGE * side.knots[-1]]
        if corners.size:
            corner = side.place(corners[-1])[3:]
            if np.linalg.norm(corner - sides[1 - index].fine[0]) >= min_thickness:  # between two corners
                starts = [0.0, 0.0]
                starts[index] = corners[-1]
                return starts, 0.0
    starts = _cut(sides, min_thickness, name)
    ends = [side.place(start)[3:] for side, start in zip(sides, starts, strict=True)]
    foremost = min((side.fine @ chord).min() for side in sides)
    return starts, float(chord @ np.mean(ends, axis=0) - foremost)


def _cut(sides: list[_Curve], min_thickness: float, name: str) -> list[float]:
    """Parameters of both sides where the thickness across the camber line reaches `min_thickness`."""
    outline = np.vstack([sides[0].fine, sides[1].fine[::-1]])
    try:
        line = camber_line(np.stack([outline, np.roll(outline, -1, axis=0)], axis=1))
    except ValueError as error:
        raise ValueError(f"section {name}: is {error}") from error
    start = (sides[0].fine[0] + sides[1].fine[0]) / 2
    if np.linalg.norm(line[-1] - start) < np.linalg.norm(line[0] - start):
        line = line[::-1]
    arc = arc_length(line)
    places = _CUTS[::-1] * arc[-1]
    points = np.stack([np.interp(places, arc, axis) for axis in line.T], axis=1)
    tangents = np.stack([np.interp(places, arc, axis) for axis in np.gradient(line, arc, axis=0).T], axis=1)
    across = np.stack([-tangents[:, 1], tangents[:, 0]], axis=1)
    across /= np.linalg.norm(tangents, axis=1, keepdims=True)
    inner = None
    for point, normal in zip(points, across, strict=True):  # from the middle to the edge
        met = [_nearest(side, point, normal) for side in sides]
        gap = 0.0 if None in met else abs(met[0][0] - met[1][0])
        if gap < min_thickness:
            break
        inner = [parameter for _, parameter in met]
    if inner is None:
        raise ValueError(f"section {name}: is too thin in the middle of its chord to be cut at its edges")
    return inner


def _nearest(side: _Curve, point: np.ndarray, normal: np.ndarray) -> tuple[float, float] | None:
    """Distance to the nearest point of `side` on the line along `normal`, and the parameter there."""
    distance, place = crossings(np.stack([side.fine[:-1], side.fine[1:]], axis=1), point, normal)
    if not distance.size:
        return None
    index = np.argmin(np.abs(distance))
    numbers = np.arange(len(side.fine_parameter))
    return distance[index], float(np.interp(place[index], numbers, side.fine_parameter))


def _paired(sides: list[_Curve], starts: list[float], stops: list[float]) -> tuple[np.ndarray, float]:
    """Places (201, 2, 3) on both sides at `SAMPLES` of the camber line between them, and its length."""
    parameters = [
        _even(side, start, side.knots[-1] - stop)
        for side, start, stop in zip(sides, starts, stops, strict=True)
    ]
    pairs = list(zip(sides, parameters, strict=True))
    first, second = (side.place(parameter)[:, 3:] for side, parameter in pairs)
    arc, share = arc_length((first + second) / 2), np.linspace(0, 1, len(first))
    sample_share = np.interp(SAMPLES, arc / arc[-1], share)
    places = [side.place(np.interp(sample_share, share, parameter))[:, :3] for side, parameter in pairs]
    return np.stack(places, axis=1), float(arc[-1])


def _even(side: _Curve, start: float, stop: float) -> np.ndarray:
    """Parameters at even steps of the arc length between two of them."""
    inside = (side.fine_parameter > start) & (side.fine_parameter < stop)
    parameter = np.concatenate([[start], side.fine_parameter[inside], [stop]])
    arc = arc_length(side.place(parameter)[:, 3:])
    return np.interp(np.linspace(0, arc[-1], 8 * SAMPLES.size), arc, parameter)


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
    _check(profiles)
    return profiles


def _check_units(sections: list[Section], frame: Frame) -> None:
    """Check the lengths of the sections against each other."""
    hub, tip = (np.hypot(*section.points[..., 1:].T).mean() for section in (sections[0], sections[-1]))
    length = abs(tip - hub)
    frame.check_length(length)
    for section in sections:
        chord = np.linalg.norm(np.ptp(section.points.mean(axis=0)[[0, -1]], axis=0))
        if chord > WIDEST * length:
            label = f"section {section.name} (line {section.lines[0]}): its chord of {chord:.4g} m"
            fault = f"is more than {WIDEST:g} times the length of the blade, {length:.4g} m"
            raise ValueError(f"{label} {fault}; all lengths must be in one unit")


def _check(profiles: list[Profile]) -> None:
    """Check that no section is a film, which takes hours to reduce, and each lies above that before."""
    for section in profiles:
        if section.thickness < THINNEST * section.chord:
            raise ValueError(
                f"section {section.name} is {1e3 * section.thickness:.2g} mm thick over a chord of "
                f"{1e3 * section.chord:.3g} mm; must be {THINNEST:.1%} of it or more: are angles and lengths "
                "in their units (blade.source.angle_unit)?"
            )
    for below, above in pairwise(profiles):
        if above.radius <= below.radius:
            raise ValueError(
                f"section {above.name}: its mean radius of {above.radius:.4g} m is not above that of section "
                f"{below.name} before it, {below.radius:.4g} m; sections must go from hub to tip"
            )
        gap = above.samples[..., 1] - below.samples[..., 1]
        if gap.min() <= 0:
            share = SAMPLES[np.argmin(gap.min(axis=1))]
            fault = f"is not the farther from the engine axis at {share:.0%} of the chord"
            raise ValueError(f"sections {below.name} and {above.name} cross: {above.name} {fault}")
