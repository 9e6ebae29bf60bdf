"""The parametric blade as a table of sections, for CAD and other programs, and for `bladerub import`."""

from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.blade.geometry import BladeShape
from bladerub.extras.blades.origin import Frame
from bladerub.extras.blades.section_table import CYLINDRICAL, POINTS
from bladerub.io import atomic

N_SECTIONS, N_STATIONS = 21, 61
_FINE = 4000  # points along a side: angles interpolated between them are accurate to 1e-8
_SAME = 1e-9  # of the axial chord
_STATIONS = (1 - np.cos(np.linspace(0, np.pi, N_STATIONS))) / 2  # along the chord, closer at its ends


def write_sections(path: str | Path, shape: BladeShape, coordinates: str) -> tuple[int, int]:
    """Write `shape` as a table of sections, hub to tip; return the number of sections and of all stations.

    Units and axes are the defaults of an import: m, rad, the blade's frame. Coordinates are ``cartesian``,
    points of the surface, or ``cylindrical``, axial position, radius and angles, which raises ValueError for
    a side that goes back along the axis (`bladerub.extras.blades.section_table`).
    """
    section, columns = (_cartesian, POINTS) if coordinates == "cartesian" else (_cylindrical, CYLINDRICAL)
    heights = enumerate(np.linspace(0, 1, N_SECTIONS).tolist(), 1)
    parts = {number: pd.DataFrame(section(shape, zeta), columns=list(columns)) for number, zeta in heights}
    frame, table = Frame(), pd.concat(parts, names=["section"])
    with atomic.writing(path) as stream:
        stream.write(
            f"# sections of the blade, hub to tip; m, rad; it turns about {frame.rotation}, the air flows "
            f"along {frame.downstream}\n"
        )
        table.droplevel(1).to_csv(stream, float_format="%.12g")
    return len(parts), len(table)


def _cartesian(shape: BladeShape, zeta: float) -> np.ndarray:
    """Points (61, 6) of both sides at the same places along the chord."""
    return np.hstack([shape.points(_STATIONS, side, zeta).T for side in (0.0, 1.0)])


def _cylindrical(shape: BladeShape, zeta: float) -> np.ndarray:
    """Axial positions, radii and angles (n, 4) of both sides; an edge askew to the axis is part of a side."""
    edges = [shape.points(np.array(xi), np.array([0.0, 1.0]), zeta)[0] for xi in (0.0, 1.0)]
    is_askew = [np.ptp(edge) > _SAME * (edges[1].max() - edges[0].min()) for edge in edges]
    outlines = []
    for side in (0, 1):
        first = np.argmin(edges[0]) if is_askew[0] else side
        last = np.argmax(edges[1]) if is_askew[1] else side
        outlines.append(_outline(shape, zeta, side, first, last))
    foremost, rearmost = edges[0].max(), edges[1].min()
    axial = foremost + (rearmost - foremost) * _STATIONS
    if is_askew[0]:
        axial = np.insert(axial, 0, edges[0].min())
    if is_askew[1]:
        axial = np.append(axial, edges[1].max())
    (radius, theta1), (_, theta2) = (
        [np.interp(axial, outline[0], values) for values in outline[1:]] for outline in outlines
    )
    return np.column_stack([axial, radius, theta1, theta2])


def _outline(shape: BladeShape, zeta: float, side: int, first: int, last: int) -> np.ndarray:
    """Axial position, radius and angle (3, n) along `side`, with the edges from `first` and to `last`."""
    path = np.array([(0.0, first), (0.0, side), (1.0, side), (1.0, last)])  # of (ξ, η)
    path = path[np.concatenate([[True], np.any(np.diff(path, axis=0) != 0, axis=1)])]
    number = np.arange(len(path))
    fine = np.linspace(0, number[-1], _FINE * number[-1] + 1)
    x, y, z = shape.points(*(np.interp(fine, number, coordinate) for coordinate in path.T), zeta)
    if (np.diff(x) <= 0).any():
        raise ValueError(f"the section at {zeta:.0%} of the span goes back along the axis; choose cartesian")
    return np.stack([x, np.hypot(y, z), -np.arctan2(y, z)])
