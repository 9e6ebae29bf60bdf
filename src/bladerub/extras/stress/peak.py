"""The largest stress of a blade in motion, with its place and time.

The stress of `bladerub.extras.stress.nodal` is that at the running position plus a part linear in the
displacement, and so in the coordinates of the motion: that part is found once for each coordinate, not for
each instant. All nodes are looked at in few instants, all instants at few nodes, in turns until neither finds
a larger stress.
"""

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable

from bladerub.contact.laws import solver_digest
from bladerub.extras.stress.nodal import NodalStress
from bladerub.numerics.machine_code import njit_on_disk

_ROWS, _COLUMNS = (0, 1, 2, 0, 1, 2), (0, 1, 2, 1, 2, 0)
_KINDS = ("von_mises", "principal", "alternating")
# All nodes are looked at first in extremes of the coordinates that cause most stress, and of their sums, then
# some for each kind of stress in all instants, and all again at the instants of largest stress there. With 2
# nodes and 8 instants it was missed in 3 of 160 parts of runs, by up to 2 %; with these in none.
_LEADING, _FEW, _INSTANTS = 3, 16, 32


class ModalStress(NamedTuple):
    """Stress (xx, yy, zz, xy, yz, zx; Pa) at nodes of a mesh by coordinates of the motion, at one speed."""

    points: np.ndarray  # (m, 3), the nodes at rest, m
    static: np.ndarray  # (6, m), at the running position
    slope: np.ndarray  # (k, 6, m), per unit of each coordinate

    @classmethod
    def of_mesh(cls, stress: NodalStress, recovery: np.ndarray, points, nodes) -> "ModalStress":
        """Find it at `nodes` of a mesh, whose coordinates displace it by `recovery` (k, n_nodes, 3)."""
        static = _six(stress(np.zeros(points.shape)), nodes)
        slope = np.array([_six(stress(displacement), nodes) - static for displacement in recovery])
        single = np.float32  # as the displacement per coordinate is stored
        return cls(points[nodes], static.astype(single), slope.astype(single))

    def at(self, nodes: np.ndarray) -> "ModalStress":
        """Restrict the stress to these of its nodes."""
        return ModalStress(self.points[nodes], self.static[:, nodes], self.slope[:, :, nodes])

    def of(self, patterns: np.ndarray) -> "ModalStress":
        """Return it for other coordinates, of each of which `patterns` (l, k) has the present ones."""
        return self._replace(slope=np.tensordot(patterns, self.slope, axes=1))

    def __call__(self, coordinates: np.ndarray) -> np.ndarray:
        """Stress (6, m, s) at coordinates (s, k), Pa."""
        stress = self.slope.reshape(len(self.slope), -1).T @ coordinates.T
        stress += self.static.reshape(-1, 1)
        return stress.reshape(*self.static.shape, len(coordinates))


def _six(tensor: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    return tensor[nodes][:, _ROWS, _COLUMNS].T


@register_jitable
def von_mises(x, y, z, xy, yz, zx):
    """Von Mises stress of the six components, numbers or arrays, in their unit."""
    return np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3 * (xy * xy + yz * yz + zx * zx))


@register_jitable
def principal(x, y, z, xy, yz, zx):
    """Largest principal stress: the largest root of the characteristic polynomial in trigonometric form."""
    radius = von_mises(x, y, z, xy, yz, zx) / 3
    mean = (x + y + z) / 3
    x, y, z = x - mean, y - mean, z - mean
    j3 = x * y * z + 2 * xy * yz * zx - x * yz * yz - y * zx * zx - z * xy * xy
    cosine = j3 / (2 * radius**3 + 1e-30)  # no deviator, no angle
    return mean + 2 * radius * np.cos(np.arccos(np.minimum(np.maximum(cosine, -1.0), 1.0)) / 3)


def stress_peaks(
    stress: ModalStress, coordinates: np.ndarray, time: np.ndarray, parts: Sequence[slice]
) -> list[dict[str, float]]:
    """Find the largest stress in each part of a motion, of a blade whose `stress` is at its speed.

    `coordinates` (s, k) are about the running position at each instant, `time` (s,) in revolutions; `parts`
    are the instants of each part, none of them empty. Returns for each ``von_mises`` and ``principal``
    (largest principal), Pa, with place at rest ``…_x``, ``…_y``, ``…_z``, m, and ``…_time``, revolutions.
    ``alternating``, Pa, with its place: half the von Mises stress of the difference between two instants, the
    largest of all. It is exact where one mode vibrates, and else on the safe side: the root of the sum of
    squares of half the range of the five terms ``√3/2 (x − y)``, ``(x + y)/2 − z`` and √3 times the shear
    stresses, as the von Mises stress is of the terms themselves.
    """
    starts = [_largest(stress(extreme))[0] for extreme in _extremes(stress, coordinates, parts)]
    few = min(_FEW, stress.points.shape[0])
    nodes = np.unique([np.argpartition(start, -few)[:, -few:] for start in starts])
    peaks: list[dict[str, tuple[float, int, int]]] = [{} for _ in parts]  # stress, node, instant of each kind
    visited = {*nodes.tolist()}
    while nodes.size:
        values, candidates = stress.at(nodes)(coordinates), set()
        for part, largest in zip(parts, peaks, strict=True):
            maxima, instant, over_nodes = _largest(values[..., part])
            for kind, node in enumerate(maxima.argmax(axis=1)):
                if (name := _KINDS[kind]) not in largest or maxima[kind, node] > largest[name][0]:
                    largest[name] = maxima[kind, node], int(nodes[node]), instant[kind, node]
            highest = np.argpartition(over_nodes, -_INSTANTS)[-_INSTANTS:]
            elsewhere = stress(coordinates[part][[*highest, largest["principal"][2]]])
            candidates |= {*_largest(elsewhere)[0][:2].argmax(axis=1).tolist()}
        nodes = np.array(sorted(candidates - visited), int)
        visited |= candidates
    return [_named(stress, largest, time[part]) for part, largest in zip(parts, peaks, strict=True)]


def _named(stress: ModalStress, largest: dict[str, tuple], time: np.ndarray) -> dict[str, float]:
    figures = {}
    for name, (value, node, instant) in largest.items():
        figures |= _at(stress, name, value, node)
        if name != "alternating":
            figures[f"{name}_time"] = float(time[instant])
    return figures


def _extremes(stress: ModalStress, coordinates: np.ndarray, parts: Sequence[slice]) -> list[np.ndarray]:
    """Coordinates, in each part, where those that cause most stress are largest, each alone and added up."""
    slope = np.abs(stress.slope).max(axis=(1, 2))
    leading = np.argsort(slope * np.ptp(coordinates, axis=0))[-_LEADING:]
    signs = np.array([*product((-1.0, 0.0, 1.0), repeat=leading.size)], stress.slope.dtype)
    sums = (signs * slope[leading]) @ coordinates[:, leading].T
    return [coordinates[part][np.unique(sums[:, part].argmax(axis=1))] for part in parts]


@njit_on_disk(solver_digest(), nogil=True)
def _largest(values):
    """Find the largest of values (6, m, s) for each node: stress of each of `_KINDS` and instant, (3, m).

    Also the largest von Mises stress of all nodes at each instant (s,). The principal stress is the mean
    stress and two thirds of the von Mises stress at most: only where that exceeds the largest is it found.
    """
    _, n_nodes, n_instants = values.shape
    largest, instants = np.full((3, n_nodes), -np.inf), np.zeros((3, n_nodes), np.int64)
    over_nodes = np.zeros(n_instants)
    low, high = np.empty(5), np.empty(5)
    for node in range(n_nodes):
        low[:], high[:] = np.inf, -np.inf
        for instant in range(n_instants):
            x, y, z = values[0, node, instant], values[1, node, instant], values[2, node, instant]
            xy, yz, zx = values[3, node, instant], values[4, node, instant], values[5, node, instant]
            mises = von_mises(x, y, z, xy, yz, zx)
            over_nodes[instant] = max(over_nodes[instant], mises)
            if mises > largest[0, node]:
                largest[0, node], instants[0, node] = mises, instant
            if (x + y + z + 2 * mises) / 3 > largest[1, node]:
                first = principal(x, y, z, xy, yz, zx)
                if first > largest[1, node]:
                    largest[1, node], instants[1, node] = first, instant
            for term, value in enumerate((x - y, x + y - z - z, xy, yz, zx)):
                low[term], high[term] = min(low[term], value), max(high[term], value)
        squares = ((high - low) / 2) ** 2
        largest[2, node] = np.sqrt((3 * squares[0] + squares[1]) / 4 + 3 * squares[2:].sum())
    return largest, instants, over_nodes


def stressed_nodes(stress: ModalStress, share: float) -> np.ndarray:
    """Numbers of nodes where rotation or a coordinate causes over `share` of its largest von Mises stress."""
    parts = von_mises(*np.moveaxis(np.concatenate([stress.static[None], stress.slope]), 1, 0))
    return np.flatnonzero((parts > share * parts.max(axis=1, keepdims=True)).any(axis=0))


def static_peak(stress: ModalStress) -> dict[str, float]:
    """Find the largest stress at the running position: ``von_mises`` and ``principal``, as `stress_peaks`."""
    largest = {"von_mises": von_mises(*stress.static), "principal": principal(*stress.static)}
    mises, first = (_at(stress, name, values.max(), values.argmax()) for name, values in largest.items())
    return mises | first


def _at(stress: ModalStress, name: str, value: float, node: int) -> dict[str, float]:
    x, y, z = map(float, stress.points[node])
    return {name: float(value), f"{name}_x": x, f"{name}_y": y, f"{name}_z": z}
