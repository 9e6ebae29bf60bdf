"""Polar views of the casing: the casing angle runs with the rotation, from the stacking line at the top."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes


def open_polar(figure: Figure, *position: int) -> PolarAxes:
    """Add polar axes to `figure` at the subplot `position`; labels of the radius stay readable over lines."""
    axes = figure.add_subplot(*position, projection="polar")
    axes.set_theta_zero_location("N")
    axes.set_thetagrids(range(0, 360, 45))
    axes.set_rlabel_position(90)
    axes.tick_params(labelsize=7)
    for label in axes.get_yticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.8})
    return axes


def close(angle: np.ndarray, radius: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles and radii (n + 1,) with the first point repeated at the end, so that the line closes."""
    angle, radius = np.asarray(angle), np.asarray(radius)
    return np.append(angle, angle[0] + 2 * np.pi), np.append(radius, radius[0])
