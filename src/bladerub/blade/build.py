"""From the config to the reduced blade and the tables that say how good it is."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade import geometry
from bladerub.blade.built import BuiltBlade, mesh_path
from bladerub.blade.discrete import DiscreteBlade, by_finite_elements
from bladerub.blade.elasticity import Material
from bladerub.blade.mesh import BladeMesh, MeshedBlade
from bladerub.blade.model import N_INTERFACE, n_interface
from bladerub.blade.reduction import fit_speeds
from bladerub.blade.refinement import MOST_FIT_SPEEDS, reduce_to_tolerance
from bladerub.blade.sources import matrix_folder, origin
from bladerub.blade.sources.frame import Frame
from bladerub.blade.sources.importing import import_blade
from bladerub.blade.sources.matrices import import_matrices
from bladerub.io import hdf5
from bladerub.io.errors import BadInput

LENGTH_TOLERANCE = 0.05  # of ``blade.length`` to what an import measures: its root need not be a cylinder


def made_from(config: Mapping[str, Any]) -> str:
    """Write down what of `config` determines the blade: equal for two configs of the same blade.

    Raises OSError or ValueError if a file that the blade comes from cannot be read or is missing.
    """
    blade = config["blade"]
    spec = blade.get("source", {})
    if spec:
        spec = asdict(Frame()) | spec  # what a config leaves out is not another blade
    if "matrices" in spec:
        paths = matrix_folder.files(origin.read(spec).folder)
        content = {name: _digest(path) for name, path in paths.items()}
        blade = {"length": blade["length"], "source": {**spec, "matrices": content}}
    elif spec:
        source = origin.read(spec)
        parts = ("material", "length", *(("mesh",) if source.is_table else ()))
        blade = {name: blade[name] for name in parts}
        blade["source"] = {**spec, "file": _digest(source.file)}
    return json.dumps({"blade": blade, "reduction": config["reduction"]}, sort_keys=True)


def is_built(config: Mapping[str, Any], path: Path) -> bool:
    """Return whether the reduced blade at `path` was built from `config`, as its mesh states."""
    mesh = mesh_path(path)
    if not (path.exists() and mesh.exists()):
        return False
    return hdf5.read_attributes(mesh).get("made_from") == made_from(config)


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def build(config: Mapping[str, Any]) -> BuiltBlade:
    """Build the blade of the ``blade`` and ``reduction`` blocks of `config`.

    Raises ValueError if the blade cannot be meshed, its subclass BadInput if it cannot be imported, is not of
    its length or ``reduction.tolerance`` is not reached, EquilibriumError if it has no static equilibrium.
    """
    if "matrices" in config["blade"].get("source", {}):
        return reduce_given(_of_matrices(config), config)
    return reduce_meshed(meshed_blade(config["blade"], n_interface(config)), config)


def frequency_at_rest(config: Mapping[str, Any]) -> float:
    """Return the first frequency at rest (Hz) of the blade that `build` builds; raises the same."""
    if "matrices" in config["blade"].get("source", {}):
        return float(_of_matrices(config).frequency[0])
    material = Material.from_config(config["blade"]["material"])
    blade = meshed_blade(config["blade"], n_interface(config))
    return float(by_finite_elements(blade, material, (), (), 1).frequency[0])


def reduce_meshed(blade: MeshedBlade, config: Mapping[str, Any]) -> BuiltBlade:
    """Reduce a meshed blade with as many speeds and modes as its tolerance asks for; see `build`."""

    @lru_cache(maxsize=1)  # more modes at each speed need no new equilibria
    def discrete(n_speeds: int) -> DiscreteBlade:
        return discretise(blade, {**config, "reduction": {**config["reduction"], "fit_speeds": n_speeds}})

    return reduce_to_tolerance(discrete, config, made_from(config), MOST_FIT_SPEEDS)


def reduce_given(blade: DiscreteBlade, config: Mapping[str, Any]) -> BuiltBlade:
    """Reduce a blade of given matrices with as many modes as its tolerance asks for; see `build`."""
    return reduce_to_tolerance(lambda _: blade, config, made_from(config), len(fit_speeds(1.0)))


def _of_matrices(config: Mapping[str, Any]) -> DiscreteBlade:
    """Read the matrices that `config` names, of a blade of its length."""
    length, reduction = config["blade"]["length"], config["reduction"]
    source = origin.read(config["blade"]["source"])
    imported = import_matrices(
        source, reduction["f_omega_max"], reduction["accuracy_modes"], reduction["modes_per_speed"]
    )
    layout = imported.blade.layout
    tip_radius = np.hypot(*layout.mesh.mesh.points[layout.mesh.tip, 1:].T).mean()
    if imported.is_rooted:
        _check_length(length, layout.length, source.folder)
    elif not (1 - LENGTH_TOLERANCE) * layout.length <= length < tip_radius:
        raise BadInput(
            f"blade.length = {length:g}: must be that of the blade in {source.folder}, whose nodes reach "
            f"over {layout.length:.4g} m up to a tip at a radius of {tip_radius:.4g} m"
        )
    return imported.blade


@threadpool_limits.wrap(limits=1)
def meshed_blade(blade: Mapping[str, Any], n_nodes: int = N_INTERFACE) -> MeshedBlade:
    """Mesh the blade of the ``blade`` block, or the one of its source, with `n_nodes` interface nodes."""
    if "source" not in blade:
        geometry.check(blade, n_nodes)
        shape = geometry.BladeShape.from_config(blade)
        return MeshedBlade(
            BladeMesh.from_shape(shape, blade["mesh"], n_nodes), shape.tip_cone, blade["length"]
        )
    imported = import_blade(origin.read(blade["source"]), blade["mesh"], n_nodes).blade
    _check_length(blade["length"], imported.length, blade["source"]["file"])
    return imported


def _check_length(length: float, measured: float, path: str | Path) -> None:
    if abs(measured / length - 1) > LENGTH_TOLERANCE:
        raise BadInput(
            f"blade.length = {length:g}: must be that of the blade in {path}, {measured:.4g} m to within "
            f"{LENGTH_TOLERANCE:.0%}; clearances are in this unit"
        )


def discretise(blade: MeshedBlade, config: Mapping[str, Any]) -> DiscreteBlade:
    """Discretise `blade` by finite elements of the material and at the speeds that `config` asks for."""
    reduction = config["reduction"]
    f_max = reduction["f_omega_max"]
    return by_finite_elements(
        blade,
        Material.from_config(config["blade"]["material"]),
        fit_speeds(f_max, reduction.get("fit_speeds", 3)),
        np.linspace(0, f_max, reduction["accuracy_speeds"]).tolist(),
        reduction["accuracy_modes"],
    )
