"""The largest stress of a blade in motion, with its place and time.

The stress of `bladerub.blade.stress` is that at the running position plus a part linear in the displacement,
and so in the reduced coordinates: that part is found once for each coordinate, not once for each instant.
All instants are looked at only for the nodes whose stress is high in a part of them.
"""

from collections.abc import Iterator

import numpy as np

from bladerub.blade.stress import NodalStress

_COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
_AT_ONCE = 64
"""Instants whose stress is in memory together."""
_SPARSE = 8
"""All nodes are looked at in every so many instants."""
_HIGH = 0.5
"""Share of the largest stress found there above which a node is looked at in all instants."""


class ModalStress:
    """Stress at the nodes of a mesh as a function of the reduced coordinates.

    Parameters
    ----------
    stress : NodalStress
        At a displacement about the running position, for one speed.
    recovery : (n, n_nodes, 3) ndarray
        Displacement of the nodes for a unit of each reduced coordinate.
    points : (n_nodes, 3) ndarray
        The nodes at rest, m.
    """

    def __init__(self, stress: NodalStress, recovery: np.ndarray, points: np.ndarray):
        static = _six(stress(np.zeros(points.shape)))
        of_elements = np.isfinite(static[:, 0])  # the stress of other nodes is not known
        self.points = points[of_elements]
        self.static = static[of_elements]  # (node, component), Pa
        slopes = [_six(stress(shape))[of_elements] - self.static for shape in recovery]
        self._slope = np.reshape(slopes, (len(recovery), -1))

    def at(self, nodes: np.ndarray) -> "ModalStress":
        """Restrict the stress to these of its nodes."""
        part = object.__new__(ModalStress)
        part.points, part.static = self.points[nodes], self.static[nodes]
        part._slope = self._slope.reshape(len(self._slope), *self.static.shape)[:, nodes].reshape(
            len(self._slope), -1
        )
        return part

    def __call__(self, coordinates: np.ndarray) -> np.ndarray:
        """Stress (s, n_nodes, 6) at reduced coordinates (s, n): xx, yy, zz, xy, yz, zx, Pa."""
        return (coordinates @ self._slope).reshape(-1, *self.static.shape) + self.static


def _six(tensor: np.ndarray) -> np.ndarray:
    return np.stack([tensor[..., i, j] for i, j in _COMPONENTS], axis=-1)


def invariants(stress: np.ndarray) -> dict[str, np.ndarray]:
    """Von Mises and largest principal stress (...) of six components (..., 6), in their unit.

    The principal stress is the largest root of the characteristic polynomial in trigonometric form.
    """
    mean = stress[..., :3].mean(axis=-1)
    x, y, z = np.moveaxis(stress[..., :3] - mean[..., None], -1, 0)
    xy, yz, zx = np.moveaxis(stress[..., 3:], -1, 0)
    j2 = 0.5 * (x * x + y * y + z * z) + xy * xy + yz * yz + zx * zx
    j3 = x * y * z + 2 * xy * yz * zx - x * yz * yz - y * zx * zx - z * xy * xy
    radius = np.sqrt(j2 / 3)
    with np.errstate(invalid="ignore", divide="ignore"):  # no deviator, no angle
        cosine = np.nan_to_num(j3 / (2 * radius**3), posinf=1.0, neginf=-1.0)
    angle = np.arccos(np.clip(cosine, -1.0, 1.0)) / 3
    return {"von_mises": np.sqrt(3 * j2), "principal": mean + 2 * radius * np.cos(angle)}


def stress_peak(stress: ModalStress, coordinates: np.ndarray, time: np.ndarray) -> dict[str, float]:
    """Find the largest stress of a motion.

    Parameters
    ----------
    stress : ModalStress
        Of the blade at the speed of the motion.
    coordinates : (s, n) ndarray
        Reduced coordinates about the running position at each instant.
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
    stress = stress.at(_high_nodes(stress, coordinates[::_SPARSE]))
    largest: dict[str, float] = {}
    low = np.full(stress.static.shape, np.inf)
    high = -low
    for first, values in _chunks(stress, coordinates):
        low, high = np.minimum(low, values.min(axis=0)), np.maximum(high, values.max(axis=0))
        for name, found in invariants(values).items():
            instant, node = np.unravel_index(found.argmax(), found.shape)
            if found[instant, node] > largest.get(name, -np.inf):
                largest |= _at(stress, name, found[instant, node], int(node))
                largest[f"{name}_time"] = float(time[first + instant])
    alternating = invariants((high - low) / 2)["von_mises"]
    node = int(alternating.argmax())
    return largest | _at(stress, "alternating", alternating[node], node)


def _high_nodes(stress: ModalStress, coordinates: np.ndarray) -> np.ndarray:
    """Numbers of the nodes at which von Mises or principal stress or their range come near the largest."""
    low = np.full(stress.static.shape, np.inf)
    high, highest = -low, np.zeros(len(low))
    for _, values in _chunks(stress, coordinates):
        low, high = np.minimum(low, values.min(axis=0)), np.maximum(high, values.max(axis=0))
        found = invariants(values)
        highest = np.fmax(highest, np.fmax(found["von_mises"], found["principal"]).max(axis=0))
    ranges = invariants((high - low) / 2)["von_mises"]
    return np.flatnonzero((highest > _HIGH * highest.max()) | (ranges > _HIGH * ranges.max()))


def static_peak(stress: ModalStress) -> dict[str, float]:
    """Find the largest stress at the running position: ``von_mises`` and ``principal``, as `stress_peak`."""
    found = invariants(stress.static)
    at = [_at(stress, name, of.max(), int(of.argmax())) for name, of in found.items()]
    return at[0] | at[1]


def _chunks(stress: ModalStress, coordinates: np.ndarray) -> Iterator[tuple[int, np.ndarray]]:
    for first in range(0, len(coordinates), _AT_ONCE):
        yield first, stress(coordinates[first : first + _AT_ONCE])


def _at(stress: ModalStress, name: str, value: float, node: int) -> dict[str, float]:
    x, y, z = map(float, stress.points[node])
    return {name: float(value), f"{name}_x": x, f"{name}_y": y, f"{name}_z": z}
