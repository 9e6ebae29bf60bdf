"""The blade itself for other programs, a part of ``bladerub export``."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub.cli import inputs
from bladerub.io.errors import BadInput
from bladerub.settings.units import speed_in_words

if TYPE_CHECKING:
    from bladerub.settings.study import Config

COORDINATES = ("cartesian", "cylindrical")
FORMS = (
    ("--calculix", "DIR", "a folder for CalculiX decks, one for each speed"),
    ("--mesh", "FILE", "new mesh with node sets: .inp, .msh, or .vtu with modes and centrifugal motion"),
    ("--matrices", "FILE", "new file of the reduced blade: .npz or .mat"),
    ("--fe-matrices", "DIR", "a new folder for what bladerub import reads: finite element matrices, nodes"),
    ("--sections", "FILE", "new table of sections of a parametric blade: .csv, .txt, .dat"),
)
"""What can be written of the blade: option, name of its value and help."""


def write(options: argparse.Namespace, config: "Config") -> tuple[dict[str, Any], str]:
    """Write what the command line asks for of the blade; return what was written, also in words."""
    if options.fe_matrices:
        return _write_fe_matrices(options, config)

    from bladerub.extras.export import blade_files, mesh_file

    stored_blade, config = inputs.read_blade(options, config)
    path, blade = stored_blade.path, stored_blade.reduced
    with inputs.refused(OSError):
        mesh = mesh_file.read_mesh(stored_blade.mesh_path, blade)
        needs_elements = options.calculix or (options.mesh and options.mesh.suffix.lower() != ".vtu")
        if needs_elements and not len(mesh["cells"]):
            raise BadInput(f"{path}: is of matrices, without elements; write --mesh with .vtu or --matrices")
        if options.matrices:
            blade_files.write_matrices(options.matrices, blade)
            files = [options.matrices]
        elif options.mesh:
            sets = {name: mesh[f"{name}_nodes"] for name in ("root", "tip", "interface")}
            fields = _fields(stored_blade.mesh_path)
            mesh_file.write_mesh_file(options.mesh, mesh["points"], mesh["cells"], sets, fields)
            files = [options.mesh]
        else:
            body = (mesh["points"], mesh["cells"], mesh["root_nodes"], config.blade.material)
            speeds = _speeds(options, blade.f_omega_max, blade.f1_hz)
            files = blade_files.write_decks(options.calculix, speeds, blade.f1_hz, *body)
    return _about(files, mesh["points"], mesh["cells"], len(blade.mass))


def _write_fe_matrices(options: argparse.Namespace, config: "Config") -> tuple[dict[str, Any], str]:
    """Compute the finite element matrices of the blade of the config again, and write them."""
    folder = options.fe_matrices
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise BadInput(f"--fe-matrices {folder}: is there already, must be a new or an empty folder")
    source = config.blade.plugged("source")
    if source and source.plugged("matrices"):
        raise BadInput("--fe-matrices: the blade of the config is of matrices already, without elements")
    inputs.require_writable("--fe-matrices", folder)
    f_max = config.reduction.f_omega_max

    from bladerub.blade.build import meshed_blade
    from bladerub.blade.cache import first_frequency
    from bladerub.blade.discrete import by_finite_elements
    from bladerub.blade.model import n_interface
    from bladerub.blade.reduction import fit_speeds
    from bladerub.extras.export.blade_files import write_fe_matrices

    f1_hz = first_frequency(config) if options.speeds else 0.0
    speeds = sorted(_speeds(options, f_max, f1_hz))
    meshed, modes = meshed_blade(config.blade, n_interface(config)), config.reduction.accuracy_modes
    blade = by_finite_elements(meshed, config.blade.material, [*fit_speeds(f_max), *speeds], [], modes)
    files = write_fe_matrices(folder, blade, f_max, f".{options.matrix_format or 'mtx'}")
    mesh = blade.layout.mesh.mesh
    return _about(files, mesh.points, mesh.cells, blade.free.free.size)


def _about(files: list[Path], points: Any, cells: Any, coordinates: int) -> tuple[dict[str, Any], str]:
    size = {"nodes": len(points), "elements": len(cells), "coordinates": coordinates}
    text = f"blade of {len(cells)} elements, {len(points)} nodes, matrices of {coordinates} coordinates"
    figures = {"files": [str(file) for file in files]} | size
    return figures, "\n".join([text, *(f"wrote {file}" for file in files)])


def _fields(path: Path) -> dict[str, Any]:
    """Read the modes at rest and the centrifugal displacements (m) by name from ``mesh.h5``."""
    from bladerub.io import hdf5

    data, _ = hdf5.read(path, {"mode_shape", "frequency", "static_displacement", "f_omega"})
    modes = enumerate(zip(data["frequency"], data["mode_shape"], strict=True), 1)
    moved = zip(data["f_omega"], data["static_displacement"], strict=True)
    return {f"mode_{number}_{hertz:.5g}_Hz": shape for number, (hertz, shape) in modes} | {
        f"centrifugal_{f_omega:.4f}": displacement for f_omega, displacement in moved if f_omega > 0
    }


def _speeds(options: argparse.Namespace, highest: float, f1_hz: float) -> list[float]:
    if options.speeds is None:
        return [0.0, highest / 2, highest]

    from bladerub.config.quantities import number

    speeds = []
    for typed in options.speeds:
        with inputs.refused(ValueError, because=f"--speeds {typed}: "):
            speeds.append(number("f_omega", typed, lambda _: f1_hz))
        if not 0 <= speeds[-1] <= highest:
            raise BadInput(f"--speeds {typed}: must be from 0 to {speed_in_words(highest, f1_hz)}")
    return list(dict.fromkeys(speeds))


def write_sections(options: argparse.Namespace, config: "Config") -> tuple[dict[str, Any], str]:
    """Write the table that the command line asks for; return its size, also in words."""
    path = options.sections
    if source := config.blade.plugged("source"):
        origin = f"the blade is of blade.source ({', '.join(source.plain())})"
        raise BadInput(f"--sections {path}: {origin}; only a parametric one has sections")

    from bladerub.blade.geometry import BladeShape
    from bladerub.extras.export import blade_files

    shape, coordinates = BladeShape.from_config(config.blade), options.coordinates or COORDINATES[0]
    with inputs.refused(OSError), inputs.refused(ValueError, because=f"--coordinates {coordinates}: "):
        n_sections, n_stations = blade_files.write_sections(path, shape, coordinates)
    figures = {"files": [str(path)], "coordinates": coordinates}
    text = f"{n_sections} sections, {n_stations} stations in all, in m and rad, {coordinates} coordinates"
    return figures | {"sections": n_sections, "stations": n_stations}, f"{text}\nwrote {path}"
