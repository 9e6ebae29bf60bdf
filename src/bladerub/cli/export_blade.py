"""The blade itself for other programs, a part of ``bladerub export``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from bladerub.cli import inputs
from bladerub.cli.errors import InputError
from bladerub.io import errors
from bladerub.io.errors import BadInput


def add_to(form: Any) -> None:
    """Add the options that each name what to write of the blade."""
    form.add_argument(
        "--calculix",
        type=Path,
        metavar="DIR",
        help="a folder for decks for CalculiX, one for each speed",
    )
    form.add_argument(
        "--mesh",
        type=Path,
        metavar="FILE",
        help="mesh and node sets: .inp, .msh, or .vtu with modes and centrifugal displacements",
    )
    form.add_argument("--matrices", type=Path, metavar="FILE", help="the reduced blade: .npz or .mat")
    form.add_argument(
        "--fe-matrices",
        type=Path,
        metavar="DIR",
        help="a new folder for mass and stiffness of the finite elements, which are made anew for it, and a "
        "list of the nodes: what bladerub import reads",
    )
    form.add_argument(
        "--sections",
        type=Path,
        metavar="FILE",
        help="table of sections of a parametric blade: .csv, .txt, .dat",
    )


def write(options: argparse.Namespace, config: dict[str, Any]) -> dict[str, Any]:
    """Write what the command line asks for of the blade; return which files, and of how many nodes.

    Raises
    ------
    InputError
        If an option or a file is at fault.
    """
    if options.fe_matrices:
        return _write_fe_matrices(options, config)

    from bladerub.blade.elasticity import Material
    from bladerub.export import calculix, matrices, mesh_file
    from bladerub.export.vtu import read_mesh

    for option, suffixes in (("mesh", mesh_file.WRITERS), ("matrices", matrices.SUFFIXES)):
        file = getattr(options, option)
        if file and file.suffix.lower() not in suffixes:
            raise InputError(f"--{option} {file}: must end in {', '.join(suffixes)}")
    path, blade = inputs.read_blade(options, config)
    try:
        mesh = read_mesh(path.with_name("mesh.h5"), blade)
        needs_elements = options.calculix or (options.mesh and options.mesh.suffix.lower() != ".vtu")
        if needs_elements and not len(mesh["cells"]):
            raise InputError(
                f"{path}: is of matrices, without elements; write --mesh with .vtu or --matrices"
            )
        if options.matrices:
            matrices.write_matrices(options.matrices, blade)
            files = [options.matrices]
        elif options.mesh:
            sets = {name: mesh[f"{name}_nodes"] for name in ("root", "tip", "interface")}
            fields = _fields(path.with_name("mesh.h5"))
            mesh_file.write_mesh_file(options.mesh, mesh["points"], mesh["cells"], sets, fields)
            files = [options.mesh]
        else:
            files = calculix.write_decks(
                options.calculix,
                mesh["points"],
                mesh["cells"],
                mesh["root_nodes"],
                Material.from_config(config["blade"]["material"]),
                blade.f1_hz,
                _speeds(options, blade.f_omega_max),
            )
    except OSError as error:
        raise InputError(errors.message_for(error)) from error
    return {
        "files": [str(file) for file in files],
        "nodes": len(mesh["points"]),
        "elements": len(mesh["cells"]),
        "coordinates": len(blade.mass),
    }


def _write_fe_matrices(options: argparse.Namespace, config: dict[str, Any]) -> dict[str, Any]:
    """Discretise the blade of the config anew, and write its matrices."""
    folder = options.fe_matrices
    if folder.exists() and not (folder.is_dir() and not any(folder.iterdir())):
        raise InputError(f"--fe-matrices {folder}: is there already, must be a new or an empty folder")
    if "matrices" in config["blade"].get("source", {}):
        raise InputError("--fe-matrices: the blade of the config is of matrices already, without elements")
    inputs.require_room("fe-matrices", folder)
    f_max = config["reduction"]["f_omega_max"]
    speeds = sorted(_speeds(options, f_max))

    from bladerub.blade.build import meshed_blade
    from bladerub.blade.discrete import by_finite_elements
    from bladerub.blade.elasticity import Material
    from bladerub.blade.reduction import fit_speeds
    from bladerub.blade.rotation import EquilibriumError
    from bladerub.export.matrices import write_fe_matrices

    try:
        blade = by_finite_elements(
            meshed_blade(config["blade"]),
            Material.from_config(config["blade"]["material"]),
            [*fit_speeds(f_max), *speeds],
            [],
            config["reduction"]["accuracy_modes"],
        )
    except (BadInput, EquilibriumError) as error:
        raise InputError(str(error)) from error
    mesh = blade.layout.mesh.mesh
    return {
        "files": [
            str(file)
            for file in write_fe_matrices(folder, blade, f_max, f".{options.matrix_format or 'mtx'}")
        ],
        "nodes": len(mesh.points),
        "elements": len(mesh.cells),
        "coordinates": blade.free.free.size,
    }


def _fields(path: Path) -> dict[str, Any]:
    """Read the modes at rest and the centrifugal displacements (m) by name from ``mesh.h5``."""
    from bladerub.io import hdf5

    data, _ = hdf5.read(path, {"mode_shape", "frequency", "static_displacement", "f_omega"})
    modes = enumerate(zip(data["frequency"], data["mode_shape"], strict=True), 1)
    moved = zip(data["f_omega"], data["static_displacement"], strict=True)
    return {f"mode_{number}_{hertz:.5g}_Hz": shape for number, (hertz, shape) in modes} | {
        f"centrifugal_{f_omega:.4f}": displacement for f_omega, displacement in moved if f_omega > 0
    }


def _speeds(options: argparse.Namespace, highest: float) -> list[float]:
    if options.speeds is None:
        return [0.0, highest / 2, highest]
    for speed in options.speeds:
        if not 0 <= speed <= highest:
            raise InputError(f"--speeds {speed:g}: must be from 0 to {highest:g} (normalised)")
    return list(dict.fromkeys(options.speeds))


def in_words(figures: dict[str, Any]) -> str:
    """Say what was written."""
    size = f"{figures['elements']} elements, {figures['nodes']} nodes"
    about = f"blade of {size}, matrices of {figures['coordinates']} coordinates"
    return "\n".join([about, *(f"wrote {file}" for file in figures["files"])])
