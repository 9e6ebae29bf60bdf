"""Where the interface nodes stand over the coating: their strips of it, and the order of its elements."""

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import tip_radii
from bladerub.contact.spec import RunSpec


def element_angle(n_elements: int) -> np.ndarray:
    """Casing angle (N,) of the element centres, rad."""
    return (np.arange(n_elements) + 0.5) * (2 * np.pi / n_elements)


def element_passage(blade: ReducedBlade, spec: RunSpec) -> float:
    """Time in which one coating element passes, s."""
    return 1.0 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)


def element_area(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Area (j,) of one element under each node, m²."""
    radius, _ = tip_radii(blade)
    return strip_width(blade) * 2 * np.pi * radius / spec.coating.n_elements


def strip_width(blade: ReducedBlade) -> np.ndarray:
    """Axial width (j,) of the coating strip under each interface node, m: its share of the axial chord."""
    x = blade.node_position[:, 0]
    middle = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    return np.abs(np.diff(middle))


def running_clearance(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Clearance (j,) of each interface node, linear along the chord, m."""
    x, (leading, trailing) = blade.node_position[:, 0], spec.clearance
    return leading + (trailing - leading) * ((x - x[0]) / (x[-1] - x[0]))


def start_position(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Position (j,) of each node at the start of a revolution, in elements, within [0, N)."""
    angle = spec.casing.start_angle + np.arctan2(blade.node_position[:, 1], blade.node_position[:, 2])
    n_elements = spec.coating.n_elements
    return angle / (2 * np.pi) * n_elements % n_elements


def by_angle(blade: ReducedBlade, spec: RunSpec, rows: np.ndarray) -> np.ndarray:
    """Bring (N, lanes) rows of elements into the order (j, N) of the angle, for the j nodes."""
    first = start_position(blade, spec).astype(int)  # element that each node stands over: the first row
    return np.array([np.roll(of_node, shift) for of_node, shift in zip(rows.T, first, strict=False)])
