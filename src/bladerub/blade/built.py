"""What building a blade gives, and the files that keep it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.blade.files import accuracy_path, mesh_path
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.model import AXIS, ReducedBlade, interface_node, write_reduced_blade
from bladerub.io import hdf5, tables
from bladerub.io.hdf5 import Variable


@dataclass(frozen=True)
class BuiltBlade:
    """The reduced blade, the mesh that it comes from, and how well the one follows the other."""

    reduced: ReducedBlade
    mesh: BladeMesh  # at rest
    frequency: np.ndarray  # (n_modes,), of the unreduced model at rest, Hz
    mode_shape: np.ndarray  # (n_modes, n_nodes, 3), of these frequencies, largest displacement 1
    recovery: np.ndarray  # (n, n_nodes, 3), displacement of the nodes per reduced coordinate, eq. (6)
    static_displacement: np.ndarray  # (n_speeds, n_nodes, 3), from rest to the equilibria at speed, m
    static_speed: np.ndarray  # (n_speeds,), normalised, the accuracy speeds whose equilibria are known
    accuracy: pd.DataFrame  # from `bladerub.blade.frequencies.accuracy_table`
    made_from: str  # from `bladerub.blade.files.made_from`


def write(built: BuiltBlade, origin: Mapping[str, str], reduced_model: Path) -> None:
    """Write a blade to the file of its reduced model and, next to it, mesh and table of its accuracy.

    `origin` is their provenance. The mesh holds what a picture of the blade and of its motion needs, with
    node numbers from 0. The reduced model is written last: if it exists, the other files do too.
    """
    mesh = built.mesh
    numbering = (
        "nodes of each hexahedron (20) or tetrahedron (10): corners, then edges, as in CalculiX and VTK"
    )
    recovery = built.recovery.astype(np.float32)  # enough for pictures: 1e-7 of the displacement
    recovered = "displacement of the nodes per unit of each coordinate of the reduced model, eq. (5)"
    variables = {
        "axis": AXIS,
        "points": Variable(("node", "axis"), mesh.mesh.points, "m", "nodes at rest in the rotating frame"),
        "cells": Variable(("element", "element_node"), mesh.mesh.cells, "1", numbering),
        "root_nodes": Variable(("root_node",), mesh.root, "1", "clamped nodes"),
        "tip_nodes": Variable(("tip_node",), mesh.tip, "1", "nodes of the tip face"),
        "interface_nodes": Variable(
            ("interface_node",), mesh.interface, "1", "contact nodes, leading to trailing edge"
        ),
        "interface_node": interface_node(mesh.interface.size, "interface_node"),
        "mode": hdf5.numbers("mode", built.frequency.size, "mode, counted from 1"),
        "frequency": Variable(("mode",), built.frequency, "Hz", "natural frequencies at rest"),
        "mode_shape": Variable(
            ("mode", "node", "axis"), built.mode_shape, "1", "modes at rest, largest displacement component 1"
        ),
        "recovery": Variable(("coordinate", "node", "axis"), recovery, "1", recovered),
        "f_omega": Variable(("f_omega",), built.static_speed, "1", "normalised rotational frequency"),
        "static_displacement": Variable(
            ("f_omega", "node", "axis"), built.static_displacement, "m", "displacement under centrifugal load"
        ),
    }
    hdf5.write(mesh_path(reduced_model), variables, {"made_from": built.made_from}, origin)
    tables.write(accuracy_path(reduced_model), built.accuracy, origin, float_format="%.10g")
    write_reduced_blade(reduced_model, built.reduced, origin)
