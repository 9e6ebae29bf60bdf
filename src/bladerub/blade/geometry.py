"""Shape of the blade: span sections, stacked and wrapped on surfaces of revolution about the engine axis.

Frame, rotating with the blade: x is the engine axis, z the stacking line at mid chord, y completes the
right-handed system. Positive rotation increases ``phi = atan2(y, z)``, so at the stacking line the blade
moves towards +y. A section is drawn in the plane (x, t), with t the arc length around the engine axis,
positive with the rotation, and then wrapped: ``phi = t / r``.

- **stagger** turns the chord from the axis: the leading edge lies upstream (-x) and ahead in the rotation
  (+t), as in a compressor rotor.
- **camber** is the turning angle of the parabolic camber line: its hollow (pressure) side faces the
  rotation, and the trailing edge lies closer to the axial direction than the leading edge.
- **sweep** moves a section downstream (+x), **lean** moves it with the rotation (+t). Without them the
  centroids of all camber lines lie on the z axis.
- **tip cone** is the half angle of the flow path at the tip: where it is positive, tip and casing widen
  downstream. The hub is a cylinder, and the surfaces between are cones of angles in between. A blade that
  bends with the rotation also moves downstream, so a widening flow path moves its tip away from the casing.
"""

import math
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np
import scipy  # its parts when they are used: every call of snakemake imports this module

from bladerub.blade.model import N_INTERFACE
from bladerub.settings.blade import Blade, Mesh

MOST_ELEMENTS = 20_000  # some 300,000 unknowns: beyond, their factors fill the memory
EDGE_THICKNESS = 0.4  # over the largest of a section: blunt, so that hexahedra keep their shape


@dataclass(frozen=True)
class BladeShape:
    """A blade as a map from the unit cube: chordwise ξ, through the thickness η, spanwise ζ.

    Between the sections lies a cubic spline (a parabola through three, a straight line through two).
    """

    hub_radius: float  # of the clamped root, m
    length: float  # height of the blade on the stacking line, m
    tip_cone: float  # half angle of the flow path at the tip, rad; positive where it widens downstream
    span: np.ndarray  # (n,), relative height of the sections, ascending from 0 to 1
    sections: np.ndarray  # (n, 6): chord (m), thickness / chord, camber, stagger (rad), sweep, lean (m)

    @classmethod
    def from_config(cls, blade: Blade) -> "BladeShape":
        """Read the shape from the ``blade`` block of the config (angles there in degrees)."""
        span = np.array([s.span for s in blade.sections])
        names = ("chord", "thickness", "camber", "stagger", "sweep", "lean")
        sections = np.array([[getattr(section, name) for name in names] for section in blade.sections])
        sections[:, 2:4] = np.deg2rad(sections[:, 2:4])
        return cls(blade.hub_radius, blade.length, float(np.deg2rad(blade.tip_cone)), span, sections)

    def section(self, zeta: np.ndarray) -> np.ndarray:
        """Interpolate the columns of `sections` at the relative heights `zeta`: (6, ...)."""
        return np.moveaxis(_through(self.span, self.sections, zeta), -1, 0)

    def points(self, xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray) -> np.ndarray:
        """Map the unit cube to space: points (3, ...), m.

        `xi` runs from the leading to the trailing edge, `eta` from the suction to the pressure side, `zeta`
        from root to tip; the three arrays are broadcast against each other.
        """
        xi, eta, zeta = np.broadcast_arrays(xi, eta, zeta)
        chord, thickness, camber, stagger, sweep, lean = self.section(zeta)
        height = chord * np.tan(camber / 2) / 4  # of the parabola with end slopes ±tan(camber / 2)
        along = chord * (xi - 0.5)
        across = height * (2 / 3 - 4 * xi * (1 - xi))  # its centroid on the chord line
        slope = -4 * height * (1 - 2 * xi) / chord
        offset = (eta - 0.5) * chord * thickness * (1 - (1 - EDGE_THICKNESS) * (2 * xi - 1) ** 2)
        along = along - offset * slope / np.hypot(1, slope)
        across = across + offset / np.hypot(1, slope)
        x = along * np.cos(stagger) + across * np.sin(stagger) + sweep
        t = -along * np.sin(stagger) + across * np.cos(stagger) + lean
        radius = self.hub_radius + zeta * (self.length + x * np.tan(self.tip_cone))
        return np.stack([x, radius * np.sin(t / radius), radius * np.cos(t / radius)])


def _through(x: np.ndarray, rows: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Interpolate `rows` (n, k) at the places `x` (n,) as SciPy's cubic spline does: (..., k).

    Up to three rows without SciPy, to the same bits: `scipy.interpolate` takes most of a second to import,
    and every command checks the shape of a blade.
    """
    if len(x) > 3:
        return scipy.interpolate.CubicSpline(x, rows)(at)
    width = np.diff(x)[:, None]
    chord = np.diff(rows, axis=0) / width
    if len(x) == 2:
        slope = chord[[0, 0]]
    else:
        (before,), (after,) = width
        system = [[1, 1, 0], [after, 2 * (before + after), before], [0, 1, 1]]
        middle = 3 * (before * chord[1] + after * chord[0])
        slope = np.linalg.solve(system, [2 * chord[0], middle, 2 * chord[1]])
    bend = (slope[:-1] + slope[1:] - 2 * chord) / width
    piece = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    h = (at - x[piece])[..., None]
    square = (chord - slope[:-1]) / width - bend
    return rows[piece] + slope[piece] * h + square[piece] * (h * h) + (bend / width)[piece] * (h * h * h)


def lattice(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """ξ, η, ζ of the element corners of a mesh of ``chordwise`` × ``thickness`` × ``spanwise`` elements."""
    xi, eta, zeta = (np.linspace(0, 1, n + 1) for n in (mesh.chordwise, mesh.thickness, mesh.spanwise))
    return xi, eta, zeta


def check_size(mesh: Mesh) -> None:
    """Check that a mesh has no more elements than fit into memory, or raise ValueError."""
    n_elements = mesh.chordwise * mesh.thickness * mesh.spanwise
    if n_elements > MOST_ELEMENTS:
        raise ValueError(f"blade.mesh: has {n_elements} elements, must be {MOST_ELEMENTS} or fewer")


def check(blade: Blade, n_interface: int = N_INTERFACE) -> None:
    """Check that the ``blade`` block of the config describes a blade that can be meshed.

    A ValueError names the key, the value and what would be right, if the sections do not ascend from span 0
    to 1, an element would be turned inside out, or the tip has too few nodes for the interface.
    """
    spans = [section.span for section in blade.sections]
    for index, end in ((0, 0.0), (len(spans) - 1, 1.0)):
        if spans[index] != end:
            raise ValueError(
                f"blade.sections[{index}].span = {spans[index]:g}: the sections must run from span 0 to 1"
            )
    for index, (before, span) in enumerate(pairwise(spans), 1):
        if span <= before:
            raise ValueError(
                f"blade.sections[{index}].span = {span:g}: must be above that of the section before "
                f"({before:g})"
            )
    check_interface(blade.mesh, n_interface)
    xi, eta, zeta = lattice(blade.mesh)
    shape = BladeShape.from_config(blade)
    jacobian = corner_jacobians(shape.points(xi[:, None, None], eta[None, :, None], zeta[None, None, :]))
    chord = shape.section(zeta)[0]  # below zero with the thickness, it leaves the determinant positive
    inside_out = (jacobian <= 0).any(axis=(0, 1, 2)) | (chord[:-1] <= 0) | (chord[1:] <= 0)
    if inside_out.any():
        element = np.argmax(inside_out)
        raise ValueError(
            f"blade.sections: mesh turned inside out at span {zeta[element]:.3g} to {zeta[element + 1]:.3g}; "
            "chord and thickness must stay above zero between the sections, and neighbours must not cross"
        )


def check_interface(mesh: Mesh, n_interface: int = N_INTERFACE) -> None:
    """Check that the tip's camber line has enough nodes for the interface, or raise ValueError."""
    # Through an odd number of elements the line meets nodes only where it crosses their corner edges.
    n_nodes = mesh.chordwise * (2 if mesh.thickness % 2 == 0 else 1) + 1
    if n_nodes < n_interface:
        fewest = math.ceil((n_interface - 1) / 2)
        raise ValueError(
            f"blade.mesh.chordwise = {mesh.chordwise}: gives {n_nodes} nodes on the tip's camber line, "
            f"not {n_interface}; must be {fewest} or more with an even blade.mesh.thickness, else "
            f"{n_interface - 1} or more"
        )


def corner_jacobians(points: np.ndarray) -> np.ndarray:
    """Jacobian determinant (m³) at the 8 corners of each straight-edged element of a lattice of points.

    From the corners (3, nx, ny, nz) to (8, nx - 1, ny - 1, nz - 1); positive for a right-handed element.
    """
    along_xi, along_eta, along_zeta = (np.diff(points, axis=axis) for axis in (1, 2, 3))
    corners = []
    for i, j, k in product((slice(None, -1), slice(1, None)), repeat=3):  # the lower and the upper side
        face = np.cross(along_xi[:, :, j, k], along_eta[:, i, :, k], axis=0)
        corners.append(np.sum(face * along_zeta[:, i, j, :], axis=0))
    return np.stack(corners)
