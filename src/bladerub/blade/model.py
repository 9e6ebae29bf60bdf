"""The reduced blade: all that the contact simulation needs to know of the finite element model."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import numpy as np

from bladerub.io import hdf5
from bladerub.io.hdf5 import Variable
from bladerub.settings.blade import BladeSpec

N_INTERFACE = 8  # nodes on the blade tip, leading to trailing edge, if not said otherwise


def n_interface(config: BladeSpec) -> int:
    """Return the number of interface nodes that `config` asks for; matrices bring their own."""
    return config.reduction.interface_nodes or N_INTERFACE


def interface_node(n_nodes: int, dim: str = "node") -> Variable:
    """Return the numbers of `n_nodes` interface nodes, as files have them."""
    return hdf5.numbers(dim, n_nodes, "interface node, counted from 1 at the leading edge")


AXIS = Variable(("axis",), np.array(["x", "y", "z"]), "1", "x along the axis of rotation, z along the blade")

_MATRIX, _AT_NODES = ("coordinate", "coordinate_column"), ("node", "axis")


@dataclass(frozen=True, eq=False)  # one is equal to itself alone: what is found of it can be cached
class ReducedBlade:
    """Craig-Bampton model of a rotating blade with centrifugal stiffening, eqs. (2) to (6), of n coordinates.

    The first 24 are x, y, z displacements (m) of the interface nodes in turn, leading to trailing edge.
    """

    mass: Annotated[np.ndarray, _MATRIX, "kg", "reduced mass matrix"]
    stiffness_0: Annotated[np.ndarray, _MATRIX, "N/m", "constant term of the stiffness, eq. (2)"]
    stiffness_1: Annotated[np.ndarray, _MATRIX, "N/m", "coefficient of f_omega^2 in the stiffness, eq. (2)"]
    stiffness_2: Annotated[np.ndarray, _MATRIX, "N/m", "coefficient of f_omega^4 in the stiffness, eq. (2)"]
    node_position: Annotated[np.ndarray, _AT_NODES, "m", "interface nodes at rest in the rotating frame"]
    radial_direction: Annotated[
        np.ndarray, _AT_NODES, "1", "radial direction at each interface node, normal to the casing"
    ]
    tangential_direction: Annotated[
        np.ndarray, _AT_NODES, "1", "tangential direction at each interface node, positive with the rotation"
    ]
    f1_hz: float  # first eigenfrequency at rest, Hz; the unit of all normalised frequencies
    f_omega_max: float  # highest rotational frequency that the model was fitted for, normalised
    eta: int  # fixed-interface modes kept at each fit speed
    rank_tolerance: float  # relative singular value below which a column of eq. (4) is dropped
    length: float  # m
    stiffness_higher: tuple[np.ndarray, ...] = ()  # (n, n), of the 6th, 8th … power of f_Ω, if the fit has it
    tip_slope: Annotated[
        np.ndarray | None,  # where the blade does not tell
        ("node", "coordinate"),
        "1/m",
        "circumferential slope of the tip per unit of each coordinate, up with the rotation",
    ] = None

    def stiffness(self, f_omega: float) -> np.ndarray:
        """Stiffness (n, n), N/m, at the normalised `f_omega`, eq. (2); ValueError above `f_omega_max`."""
        if not 0 <= f_omega <= self.f_omega_max:
            raise ValueError(f"f_omega = {f_omega:g} is outside the fitted range [0, {self.f_omega_max:g}]")
        coefficients = (self.stiffness_0, self.stiffness_1, self.stiffness_2, *self.stiffness_higher)
        return stiffness_at(coefficients, f_omega)

    @property
    def n_interface(self) -> int:
        """Number of interface nodes."""
        return len(self.node_position)

    @property
    def tip_radius(self) -> float:
        """Mean distance of the interface nodes from the axis at rest, m; in contact each has its own."""
        return float(np.hypot(self.node_position[:, 1], self.node_position[:, 2]).mean())

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """Matrices and vectors by name; `stiffness_higher` are ``stiffness_3``, ``stiffness_4`` ..."""
        higher = {f"stiffness_{power}": matrix for power, matrix in enumerate(self.stiffness_higher, 3)}
        slope = {} if self.tip_slope is None else {"tip_slope": self.tip_slope}
        return {name: getattr(self, name) for name in _REQUIRED} | higher | slope

    @property
    def attributes(self) -> dict[str, float]:
        """Numbers by name."""
        return {name: getattr(self, name) for name in _ATTRIBUTES}


def stiffness_at(coefficients: Sequence, f_omega: float):
    """K(f_Ω) of eq. (2) from K⁰, K¹, K² and, where the fit has more speeds, those of the next even powers."""
    k0, k1, k2, *higher = coefficients
    total = k0 + f_omega**2 * k1 + f_omega**4 * k2  # eq. (2)
    return sum((f_omega ** (2 * power) * term for power, term in enumerate(higher, 3)), start=total)


_ARRAYS = {
    name: kind.__metadata__
    for name, kind in get_type_hints(ReducedBlade, include_extras=True).items()
    if hasattr(kind, "__metadata__")
}
_REQUIRED = tuple(name for name in _ARRAYS if name != "tip_slope")
_ATTRIBUTES = ("f1_hz", "f_omega_max", "eta", "rank_tolerance", "length")


def write_reduced_blade(path: str | Path, blade: ReducedBlade, origin: Mapping[str, str]) -> None:
    """Write `blade` to the HDF5 file `path`, whole or not at all; `origin` is its provenance."""
    variables = {"node": interface_node(blade.n_interface), "axis": AXIS}
    for name, data in blade.arrays.items():
        if name in _ARRAYS:
            dims, units, long_name = _ARRAYS[name]
        else:
            power = 2 * int(name.removeprefix("stiffness_"))
            dims, units, long_name = _MATRIX, "N/m", f"coefficient of f_omega^{power} in the stiffness"
        variables[name] = Variable(dims, data, units, long_name)
    hdf5.write(path, variables, blade.attributes, origin)


def reduced_blade(data: Mapping[str, np.ndarray], attributes: Mapping[str, Any]) -> ReducedBlade:
    """Return the blade of which a file holds these; raises a KeyError if one is missing."""
    names = (f"stiffness_{power}" for power in itertools.count(3))
    higher = itertools.takewhile(data.__contains__, names)
    return ReducedBlade(
        **{name: data[name] for name in _REQUIRED},
        **{name: attributes[name] for name in _ATTRIBUTES},
        stiffness_higher=tuple(data[name] for name in higher),
        tip_slope=data.get("tip_slope"),
    )
