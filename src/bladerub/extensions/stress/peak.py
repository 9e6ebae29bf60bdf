"""The largest stress of a blade in motion, with its place and time.

The stress of `bladerub.blade.stress` is that at the running position plus a part linear in the displacement,
and so in the coordinates of the motion: that part is found once for each coordinate, not for each instant.
All nodes are looked at in few instants, all instants at few nodes, in turns until neither finds a larger
stress.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

from bladerub.blade.stress import NodalStress

_ROWS, _COLUMNS = (0, 1, 2, 0, 1, 2), (0, 1, 2, 1, 2, 0)
_LEADING = 4
"""Coordinates that cause most stress: all nodes are looked at first in extremes of them and their sums."""
_NEGLIGIBLE = 1e-3
"""Share of all stress up to which coordinates together are left out."""
_FEW = 4
"""Nodes that are then looked at in all instants for each kind of stress."""
_INSTANTS = 8
"""Instants of largest stress there at which all nodes are looked at again."""


class ModalStress(NamedTuple):
    """Stress at some nodes of a mesh as a function of coordinates of the motion, at one speed.

    It has six components, xx, yy, zz, xy, yz and zx, Pa.
    """

    points: np.ndarray  # (m, 3), the nodes at rest, m
    static: np.ndarray  # (6, m), at the running position
    slope: np.ndarray  # (k, 6, m), per unit of each coordinate

    @classmethod
    def of_mesh(
        cls, stress: NodalStress, recovery: np.ndarray, points: np.ndarray, nodes: np.ndarray
    ) -> "ModalStress":
        """Find it at some of the `nodes` of a mesh.

        The coordinates displace all nodes (n_nodes, 3) by `recovery` (k, n_nodes, 3) each; `stress` is that
        of the mesh at this speed.
        """
        static = _six(stress(np.zeros(points.shape)), nodes)
        return cls(points[nodes], static, np.array([_six(stress(of), nodes) - static for of in recovery]))

    def at(self, nodes: np.ndarray) -> "ModalStress":
        """Restrict the stress to these of its nodes."""
        return ModalStress(self.points[nodes], self.static[:, nodes], self.slope[:, :, nodes])

    def of(self, patterns: np.ndarray) -> "ModalStress":
        """Return it for other coordinates, of each of which `patterns` (l, k) has the present ones."""
        return self._replace(slope=np.tensordot(patterns, self.slope, axes=1))

    def __call__(self, coordinates: np.ndarray) -> np.ndarray:
        """Stress (6, m, s) at coordinates (s, k), Pa."""
        flat = self.slope.reshape(len(self.slope), -1).T @ coordinates.T
        return flat.reshape(*self.static.shape, len(coordinates)) + self.static[..., None]


def _six(tensor: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    return tensor[nodes][:, _ROWS, _COLUMNS].T


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Von Mises stress (...) of six components (6, ...), in their unit."""
    x, y, z, xy, yz, zx = stress
    normal = (x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2
    return np.sqrt(0.5 * normal + 3 * (xy**2 + yz**2 + zx**2))


def principal(stress: np.ndarray) -> np.ndarray:
    """Largest principal stress (...) of six components (6, ...), in their unit.

    It is the largest root of the characteristic polynomial in trigonometric form.
    """
    mean = stress[:3].mean(axis=0)
    x, y, z = stress[:3] - mean
    xy, yz, zx = stress[3:]
    radius = von_mises(stress) / 3
    j3 = x * y * z + 2 * xy * yz * zx - x * yz * yz - y * zx * zx - z * xy * xy
    with np.errstate(invalid="ignore", divide="ignore"):  # no deviator, no angle
        cosine = np.nan_to_num(j3 / (2 * radius**3), posinf=1.0, neginf=-1.0)
    return mean + 2 * radius * np.cos(np.arccos(np.clip(cosine, -1.0, 1.0)) / 3)


def stress_peak(stress: ModalStress, coordinates: np.ndarray, time: np.ndarray) -> dict[str, float]:
    """Find the largest stress of a motion.

    Parameters
    ----------
    stress : ModalStress
        Of the blade at the speed of the motion.
    coordinates : (s, k) ndarray
        Its coordinates about the running position at each instant.
    time : (s,) ndarray
        The instants, revolutions.

    Returns
    -------
    dict
        ``von_mises`` and ``principal`` (largest principal), Pa, each with its place at rest ``…_x``, ``…_y``,
        ``…_z``, m, and ``…_time``, revolutions. ``alternating``, Pa, with its place: the largest von Mises
        stress of half the range of each component. It is exact where one mode vibrates, and else on the safe
        side.
    """
    most = np.abs(stress.slope).max(axis=(1, 2)) * np.ptp(coordinates, axis=0)  # that each coordinate causes
    order = np.argsort(most)
    order = order[np.cumsum(most[order]) > _NEGLIGIBLE * most.sum()][::-1]
    single = np.float32  # as the displacement per coordinate is stored
    stress = ModalStress(stress.points, stress.static.astype(single), stress.slope[order].astype(single))
    coordinates = coordinates[:, order].astype(single)
    nodes = _most_stressed(stress(coordinates[_extremes(stress, coordinates)]))
    while True:
        few = stress.at(nodes)
        values = few(coordinates)
        at = {"von_mises": _largest(von_mises(values)), "principal": _largest_principal(values)}
        highest = np.argsort(von_mises(values).max(axis=0))[-_INSTANTS:]
        elsewhere = stress(coordinates[[*highest, at["principal"][1]]])
        most = {int(of(elsewhere).max(axis=1).argmax()) for of in (von_mises, principal)}
        if most <= {*nodes.tolist()}:
            break
        nodes = np.union1d(nodes, sorted(most))
    alternating = _alternating(values)
    found = _at(few, "alternating", alternating, int(alternating.argmax()))
    for (name, (node, instant)), of in zip(at.items(), (von_mises, principal), strict=True):
        found |= _at(few, name, of(values[:, :, instant]), node) | {f"{name}_time": float(time[instant])}
    return found


def _extremes(stress: ModalStress, coordinates: np.ndarray) -> np.ndarray:
    """Instants at which the first of the coordinates are largest, each alone and added up."""
    sizes = coordinates[:, :_LEADING].T * np.abs(stress.slope[:_LEADING]).max(axis=(1, 2))[:, None]
    signs = np.array([*product((-1.0, 0.0, 1.0), repeat=len(sizes))])
    return np.unique((signs @ sizes).argmax(axis=1))


def _most_stressed(values: np.ndarray) -> np.ndarray:
    """Numbers of the nodes with the largest stress of each kind, of values (6, m, s) at some instants."""
    kinds = von_mises(values).max(axis=1), principal(values).max(axis=1), _alternating(values)
    return np.unique([np.argsort(of)[::-1][:_FEW] for of in kinds])


def _largest(values: np.ndarray) -> tuple[int, int]:
    """Node and instant of the largest of values (m, s)."""
    node, instant = np.unravel_index(values.argmax(), values.shape)
    return int(node), int(instant)


def _largest_principal(values: np.ndarray) -> tuple[int, int]:
    """Node and instant of the largest principal stress of values (6, m, s).

    It is the mean stress and two thirds of the von Mises stress at most: where that is less than one of those
    found, it need not be.
    """
    bound = values[:3].mean(axis=0) + von_mises(values) * (2 / 3)
    node, instant = _largest(bound)
    nodes, instants = np.nonzero(bound >= principal(values[:, node, instant]))
    best = principal(values[:, nodes, instants]).argmax()
    return int(nodes[best]), int(instants[best])


def _alternating(values: np.ndarray) -> np.ndarray:
    return von_mises(np.ptp(values, axis=-1) / 2)


def stressed_nodes(stress: ModalStress, share: float) -> np.ndarray:
    """Numbers of the nodes where the running position or a unit of some coordinate causes much stress.

    Much is the `share` of the largest von Mises stress by the same cause.
    """
    parts = von_mises(np.moveaxis(np.concatenate([stress.static[None], stress.slope]), 1, 0))
    return np.flatnonzero((parts > share * parts.max(axis=1, keepdims=True)).any(axis=0))


def static_peak(stress: ModalStress) -> dict[str, float]:
    """Find the largest stress at the running position: ``von_mises`` and ``principal``, as `stress_peak`."""
    found = {"von_mises": von_mises(stress.static), "principal": principal(stress.static)}
    at = [_at(stress, name, of, int(of.argmax())) for name, of in found.items()]
    return at[0] | at[1]


def _at(stress: ModalStress, name: str, values: np.ndarray, node: int) -> dict[str, float]:
    x, y, z = map(float, stress.points[node])
    return {name: float(values[node]), f"{name}_x": x, f"{name}_y": y, f"{name}_z": z}
