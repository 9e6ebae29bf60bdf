"""Stage 1 as a whole: from the config to the reduced blade and the tables that say how good it is."""

from __future__ import annotations

import hashlib
import json
import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy import sparse
from scipy.linalg import blas
from threadpoolctl import threadpool_limits

from bladerub.blade import geometry
from bladerub.blade.accuracy import CAMPBELL_COLUMNS, accuracy_table
from bladerub.blade.discrete import DiscreteBlade, by_finite_elements
from bladerub.blade.elasticity import Material
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.linear import lowest_modes
from bladerub.blade.mesh import BladeMesh, MeshedBlade
from bladerub.blade.model import AXIS, INTERFACE_NODE, ReducedBlade, write_reduced_blade
from bladerub.blade.preconditioned_cg import Nearby
from bladerub.blade.reduction import (
    Partition,
    fit_speeds,
    project,
    speed_law,
    stiffness_at,
    transformation,
)
from bladerub.blade.refinement import MOST_FIT_SPEEDS, reduce_within
from bladerub.blade.sources import matrix_folder
from bladerub.blade.sources.importing import import_blade
from bladerub.blade.sources.matrices import import_matrices
from bladerub.blade.sources.origin import MatrixSource, Source
from bladerub.io import hdf5, tables
from bladerub.io.errors import BadInput
from bladerub.io.hdf5 import Variable

log = logging.getLogger(__name__)

LENGTH_TOLERANCE = 0.05
"""How far ``blade.length`` may be from what an imported blade measures: its root need not be a cylinder."""


@dataclass(frozen=True)
class BuiltBlade:
    """All that stage 1 makes.

    Parameters
    ----------
    reduced : ReducedBlade
        The model for the contact simulations.
    mesh : BladeMesh
        The blade at rest.
    frequency : (n_modes,) ndarray
        Of the unreduced model at rest, Hz.
    mode_shape : (n_modes, n_nodes, 3) ndarray
        The modes that go with it, largest displacement 1.
    recovery : (n, n_nodes, 3) ndarray
        Displacement of the nodes per unit of each reduced coordinate, eq. (5).
    static_displacement : (n_speeds, n_nodes, 3) ndarray
        Of the equilibria at ``static_speed`` (normalised), m.
    static_speed : (n_speeds,) ndarray
        The accuracy speeds, as far as those equilibria are known.
    accuracy : DataFrame
        See `bladerub.blade.accuracy.accuracy_table`.
    made_from : str
        See `made_from`.
    """

    reduced: ReducedBlade
    mesh: BladeMesh
    frequency: np.ndarray
    mode_shape: np.ndarray
    recovery: np.ndarray
    static_displacement: np.ndarray
    static_speed: np.ndarray
    accuracy: pd.DataFrame
    made_from: str


def made_from(config: Mapping[str, Any]) -> str:
    """Write down what of `config` determines the blade, to tell later whether a blade is of a config.

    Raises
    ------
    OSError
        If the blade comes from a file that cannot be read.
    ValueError
        If a file of a folder of matrices is missing.
    """
    blade = config["blade"]
    given = blade.get("source", {})
    if "matrices" in given:
        found = matrix_folder.files(MatrixSource.from_config(given).folder)
        content = {name: _digest(path) for name, path in found.items()}
        blade = {"length": blade["length"], "source": {**given, "matrices": content}}
    elif given:
        source = Source.from_config(given)
        parts = ("material", "length", *(("mesh",) if source.is_table else ()))
        blade = {name: blade[name] for name in parts}
        blade["source"] = {**given, "file": _digest(source.file)}
    return json.dumps({"blade": blade, "reduction": config["reduction"]}, sort_keys=True)


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def build(config: Mapping[str, Any]) -> BuiltBlade:
    """Build the blade of the ``blade`` and ``reduction`` blocks of `config`.

    Raises
    ------
    ValueError
        If the blade cannot be meshed (see `bladerub.blade.geometry.check`).
    BadInput
        If it cannot be imported (see `bladerub.blade.sources`), or is not of its length.
    EquilibriumError
        If the blade has no static equilibrium at one of the speeds.
    """
    if "matrices" in config["blade"].get("source", {}):
        return reduce_given(_of_matrices(config), config)
    return reduce_meshed(meshed_blade(config["blade"]), config)


def reduce_meshed(blade: MeshedBlade, config: Mapping[str, Any]) -> BuiltBlade:
    """Reduce a blade that has a mesh, with more speeds and modes than `config` says if it needs them.

    Raises
    ------
    BadInput
        If ``reduction.tolerance`` is not reached.
    EquilibriumError
        If the blade has no static equilibrium at one of the speeds.
    """

    @lru_cache(maxsize=1)  # more modes at each speed need no new equilibria
    def discrete(n_speeds: int) -> DiscreteBlade:
        return discretise(blade, {**config, "reduction": {**config["reduction"], "fit_speeds": n_speeds}})

    return _reduce(discrete, config, MOST_FIT_SPEEDS)


def reduce_given(blade: DiscreteBlade, config: Mapping[str, Any]) -> BuiltBlade:
    """Reduce a blade whose matrices are given, with more modes than `config` says if it needs them.

    Raises
    ------
    BadInput
        If ``reduction.tolerance`` is not reached.
    """
    return _reduce(lambda _: blade, config, len(fit_speeds(1.0)))


def _reduce(
    discrete: Callable[[int], DiscreteBlade], config: Mapping[str, Any], most_fit_speeds: int
) -> BuiltBlade:
    """Reduce the blade that `discrete` gives for a number of fit speeds."""
    origin, length = made_from(config), config["blade"]["length"]

    def attempt(reduction: Mapping[str, Any]) -> BuiltBlade:
        return reduce_blade(discrete(reduction.get("fit_speeds", 3)), reduction, length, origin)

    return reduce_within(attempt, config["reduction"], most_fit_speeds)


def _of_matrices(config: Mapping[str, Any]) -> DiscreteBlade:
    """Read the matrices that `config` names, of a blade of its length."""
    length, reduction = config["blade"]["length"], config["reduction"]
    source = MatrixSource.from_config(config["blade"]["source"])
    given = import_matrices(
        source, reduction["f_omega_max"], reduction["accuracy_modes"], reduction["modes_per_speed"]
    )
    layout = given.blade.layout
    if given.is_rooted:
        _check_length(length, layout.length, source.folder)
    elif not (1 - LENGTH_TOLERANCE) * layout.length <= length < layout.tip_radius:
        raise BadInput(
            f"blade.length = {length:g}: must be that of the blade in {source.folder}, whose nodes reach "
            f"over {layout.length:.4g} m up to a tip at a radius of {layout.tip_radius:.4g} m"
        )
    return given.blade


@threadpool_limits.wrap(limits=1)
def meshed_blade(blade: Mapping[str, Any]) -> MeshedBlade:
    """Mesh the blade of the ``blade`` block of the config, or the one of its source."""
    if "source" not in blade:
        geometry.check(blade)
        shape = geometry.BladeShape.from_config(blade)
        return MeshedBlade(BladeMesh.from_shape(shape, blade["mesh"]), shape.tip_cone, blade["length"])
    given = import_blade(Source.from_config(blade["source"]), blade["mesh"]).blade
    _check_length(blade["length"], given.length, blade["source"]["file"])
    return given


def _check_length(length: float, measured: float, origin: str | Path) -> None:
    if abs(measured / length - 1) > LENGTH_TOLERANCE:
        raise BadInput(
            f"blade.length = {length:g}: must be that of the blade in {origin}, {measured:.4g} m to within "
            f"{LENGTH_TOLERANCE:.0%}; clearances are in this unit"
        )


def discretise(blade: MeshedBlade, config: Mapping[str, Any]) -> DiscreteBlade:
    """Discretise `blade` by finite elements of the material and at the speeds that `config` asks for.

    Raises
    ------
    EquilibriumError
        If the blade has no static equilibrium at one of the speeds.
    """
    reduction = config["reduction"]
    f_max = reduction["f_omega_max"]
    return by_finite_elements(
        blade,
        Material.from_config(config["blade"]["material"]),
        fit_speeds(f_max, reduction.get("fit_speeds", 3)),
        np.linspace(0, f_max, reduction["accuracy_speeds"]).tolist(),
        reduction["accuracy_modes"],
    )


@threadpool_limits.wrap(limits=1)
def reduce_blade(
    blade: DiscreteBlade, reduction: Mapping[str, Any], length: float, origin: str
) -> BuiltBlade:
    """Reduce `blade` by a ``reduction`` block, in one thread as `by_finite_elements` is.

    `length` (m) is that of the config, `origin` what `made_from` says of it.
    """
    mesh, full = blade.layout.mesh, blade.free.full
    f_max = reduction["f_omega_max"]

    partition = Partition.around(blade.free.coordinates(mesh.interface), blade.mass.shape[0])
    speeds = fit_speeds(f_max, reduction.get("fit_speeds", 3))
    fits = [blade.stiffness[f_omega] for f_omega in speeds]
    phi = transformation(
        fits,
        blade.mass,
        partition,
        reduction["modes_per_speed"],
        reduction["rank_tolerance"],
        blade.at_rest,
    )
    radial, tangential = directions(mesh.mesh.points[mesh.interface], blade.layout.tip_cone)
    k0, k1, k2, *higher = speed_law([project(stiffness, phi) for stiffness in fits], f_max)
    reduced = ReducedBlade(
        project(blade.mass, phi),
        *(k0, k1, k2),
        node_position=mesh.mesh.points[mesh.interface],
        radial_direction=radial,
        tangential_direction=tangential,
        f1_hz=float(blade.frequency[0]),
        f_omega_max=f_max,
        eta=reduction["modes_per_speed"],
        rank_tolerance=reduction["rank_tolerance"],
        length=length,
        stiffness_higher=tuple(higher),
    )
    log.info(
        "%d reduced coordinates, highest %.4g Hz", len(reduced.mass), reduced_frequencies(reduced, f_max)[-1]
    )

    by_law = _frequencies_by_law(blade, fits, f_max)
    shapes = np.stack([full(mode) for mode in blade.modes.T])
    moved = [f_omega for f_omega in blade.frequencies if f_omega in blade.displacement]
    return BuiltBlade(
        reduced,
        mesh,
        blade.frequency,
        shapes / np.abs(shapes).max(axis=(1, 2), keepdims=True),
        np.stack([full(column) for column in phi.T]),
        np.array([full(blade.displacement[f_omega]) for f_omega in moved]).reshape(-1, *shapes.shape[1:]),
        np.array(moved, dtype=float),
        accuracy_table(reduced, blade.frequencies, by_law),
        origin,
    )


def _frequencies_by_law(blade: DiscreteBlade, fits: list, f_max: float) -> dict[float, np.ndarray]:
    """Frequencies (Hz) of the unreduced `blade` with the stiffness of eq. (2), at the speeds of its own."""
    if blade.at_rest is None:
        coefficients = speed_law(fits, f_max)
        return {
            f_omega: lowest_modes(stiffness_at(coefficients, f_omega), blade.mass, blade.frequency.size)[0]
            for f_omega in blade.frequencies
        }
    shares = speed_law(np.eye(len(fits)), f_max)  # of the fits: coefficients as large would fill the memory
    found = {}
    for f_omega in blade.frequencies:
        values = np.zeros(fits[0].nnz)
        for weight, fit in zip(stiffness_at(shares, f_omega), fits, strict=True):
            values = blas.daxpy(fit.data, values, a=weight)  # in place
        law = sparse.csc_array((values, fits[0].indices, fits[0].indptr), shape=fits[0].shape)
        nearby = Nearby(law, blade.at_rest)
        found[f_omega] = nearby.lowest_modes(blade.mass, blade.modes_at_speed[f_omega])[0]
    return found


def directions(position: np.ndarray, tip_cone: float) -> tuple[np.ndarray, np.ndarray]:
    """Give unit vectors (n, 3) out of the flow path and along the rotation at points (n, 3) of the tip.

    The first is radial for a cylindrical flow path; where it widens downstream by `tip_cone` (rad) it leans
    upstream by that angle, as the normal of the casing does.
    """
    phi = np.arctan2(position[:, 1], position[:, 2])
    zero, cone = np.zeros_like(phi), np.full_like(phi, tip_cone)
    radial = np.stack([-np.sin(cone), np.cos(cone) * np.sin(phi), np.cos(cone) * np.cos(phi)], axis=1)
    return radial, np.stack([zero, np.cos(phi), -np.sin(phi)], axis=1)


def write(
    built: BuiltBlade,
    origin: Mapping[str, str],
    reduced_model: str | Path,
    mesh: str | Path,
    campbell: str | Path,
    rom_accuracy: str | Path,
) -> None:
    """Write the two HDF5 files and the two tables of stage 1; `origin` is their provenance.

    The reduced model is the last: where it is, all is.
    """
    write_mesh(mesh, built, origin)
    for path, table in ((campbell, built.accuracy[CAMPBELL_COLUMNS]), (rom_accuracy, built.accuracy)):
        tables.write(path, table, origin, float_format="%.10g")
    write_reduced_blade(reduced_model, built.reduced, origin)


def write_mesh(path: str | Path, built: BuiltBlade, origin: Mapping[str, str]) -> None:
    """Write what a picture of the blade and of its motion needs, with node numbers from 0."""
    mesh = built.mesh
    variables = {
        "axis": AXIS,
        "points": Variable(("node", "axis"), mesh.mesh.points, "m", "nodes at rest in the rotating frame"),
        "cells": Variable(
            ("element", "element_node"),
            mesh.mesh.cells,
            "1",
            "nodes of each hexahedron (20) or tetrahedron (10): corners, then edges, as in CalculiX and VTK",
        ),
        "root_nodes": Variable(("root_node",), mesh.root, "1", "clamped nodes"),
        "tip_nodes": Variable(("tip_node",), mesh.tip, "1", "nodes of the tip face"),
        "interface_nodes": Variable(
            ("interface_node",), mesh.interface, "1", "contact nodes, leading to trailing edge"
        ),
        "interface_node": replace(INTERFACE_NODE, dims=("interface_node",)),
        "mode": Variable(("mode",), np.arange(1, built.frequency.size + 1), "1", "mode, counted from 1"),
        "frequency": Variable(("mode",), built.frequency, "Hz", "natural frequencies at rest"),
        "mode_shape": Variable(
            ("mode", "node", "axis"), built.mode_shape, "1", "modes at rest, largest displacement component 1"
        ),
        "recovery": Variable(
            ("coordinate", "node", "axis"),
            built.recovery.astype(np.float32),  # 1e-7 of what is looked at
            "1",
            "displacement of the nodes per unit of each coordinate of the reduced model, eq. (5)",
        ),
        "f_omega": Variable(("f_omega",), built.static_speed, "1", "normalised rotational frequency"),
        "static_displacement": Variable(
            ("f_omega", "node", "axis"), built.static_displacement, "m", "displacement under centrifugal load"
        ),
    }
    hdf5.write(path, variables, {"made_from": built.made_from}, origin)
