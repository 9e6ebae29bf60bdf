"""Tables of sections of solids that a formula gives."""

import numpy as np
import pandas as pd

HUB, LENGTH, CHORD, THICKNESS = 0.45, 0.2, 0.08, 0.006


def twisted_plate(xi, eta, zeta):
    """A plate of constant thickness, wrapped on cylinders and twisted: x, radius, angle, as of the blade."""
    along, across = CHORD * (xi - 0.5), THICKNESS * (eta - 0.5)
    stagger = 0.5 + 0.6 * zeta
    radius = HUB + LENGTH * zeta
    x = along * np.cos(stagger) + across * np.sin(stagger)
    arc = -along * np.sin(stagger) + across * np.cos(stagger)
    return np.broadcast_arrays(x, radius, arc / radius)


def lens(xi, eta, zeta):
    """A straight one with sharp edges, both sides parabolas, in the direction of the axis."""
    radius = HUB + LENGTH * zeta
    arc = THICKNESS * (eta - 0.5) * 4 * xi * (1 - xi)
    return np.broadcast_arrays(CHORD * (xi - 0.5), radius, arc / radius)


def in_space(solid):
    """The same, as points (3, ...)."""

    def points(xi, eta, zeta):
        x, radius, phi = solid(xi, eta, zeta)
        return np.stack([x, radius * np.sin(phi), radius * np.cos(phi)])

    return points


def cartesian(solid, n_sections=9, n_stations=21):
    """Table of points of the surface; each section has two stations more than the one before."""
    parts = []
    for number, zeta in enumerate(np.linspace(0, 1, n_sections)):
        xi = np.linspace(0, 1, n_stations + 2 * number)
        sides = np.vstack([in_space(solid)(xi, side, zeta) for side in (0.0, 1.0)])
        part = pd.DataFrame(sides.T, columns=["x1", "y1", "z1", "x2", "y2", "z2"])
        part.insert(0, "section", f"s{number}")
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def cylindrical(solid, n_sections=9, n_stations=41):
    """Table of axial positions, radii and angles, the latter of the blade, along its rotation."""
    parts = []
    for number, zeta in enumerate(np.linspace(0, 1, n_sections)):
        fine = np.linspace(0, 1, 5001)
        corners = np.array(solid(np.array([0.0, 0.0, 1.0, 1.0]), np.array([0.0, 1.0, 0.0, 1.0]), zeta))[0]
        first, last = np.argmin(corners[:2]), np.argmax(corners[2:])
        axial = np.unique(np.concatenate([corners, np.linspace(corners.min(), corners.max(), n_stations)]))
        part = pd.DataFrame({"section": f"s{number}", "z": axial, "r": HUB + LENGTH * zeta})
        for side in (0, 1):
            eta = np.concatenate([np.full(5001, side), [first], [last]])
            x, _, phi = solid(np.concatenate([fine, [0.0, 1.0]]), eta, zeta)
            order = np.argsort(x, kind="stable")
            part[f"theta{side + 1}"] = np.interp(axial, x[order], phi[order])
        parts.append(part)
    return pd.concat(parts, ignore_index=True)
