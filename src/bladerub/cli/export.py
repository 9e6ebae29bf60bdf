"""``bladerub export``: a run or the blade for other programs."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from shutil import get_terminal_size
from typing import TYPE_CHECKING, Any

import numpy as np
from tqdm import tqdm

from bladerub.cli import export_blade, export_sections, inputs
from bladerub.cli.errors import InputError
from bladerub.io import errors

if TYPE_CHECKING:
    from bladerub.blade.model import ReducedBlade
    from bladerub.contact.recording import Recording
    from bladerub.study.plan import PlannedRun
    from bladerub.study.store import StoredRun

SAME = 1e-6
"""Relative difference of the peaks up to which a run computed again is the run of the file."""


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "export",
        help="write the blade's motion in a run, or the blade itself, for other programs",
        description="With --vtu: compute a run again from its file, its config and its blade, and write the "
        "motion of the finite element mesh in its last revolution. That it is the run of the file is told by "
        "its run_key and the peaks of all revolutions. With --calculix, --mesh, --matrices or "
        "--fe-matrices: write the blade, which is built first if the results folder has none yet. With "
        "--sections: write the sections of the config, for which no blade is built.",
        epilog="Open blade.pvd in ParaView and apply Warp By Vector to displacement. The mesh is the blade "
        "at rest in the rotating frame; displacement (m) is that of each node about its running position, so "
        "without the centrifugal displacement; time is in revolutions from the start of the run. Of a run "
        "that left all bounds, the last revolution within them is written.",
    )
    parser.set_defaults(command=export)
    parser.add_argument("--run", type=Path, metavar="FILE", help="the run (HDF5), for --vtu")
    form = parser.add_mutually_exclusive_group(required=True)
    form.add_argument(
        "--vtu", type=Path, metavar="DIR", help="a new folder for blade.pvd and a .vtu for each instant"
    )
    export_blade.add_to(form)
    parser.add_argument(
        "--speeds",
        nargs="+",
        type=float,
        metavar="F_OMEGA",
        help="of the decks, normalised (default: 0, half of and the highest of the reduced blade); with "
        "--fe-matrices, of a stiffness beside those at these three",
    )
    parser.add_argument(
        "--matrix-format",
        choices=("mtx", "npz"),
        help="of --fe-matrices: Matrix Market, or what scipy.sparse.load_npz reads (default mtx)",
    )
    parser.add_argument(
        "--coordinates",
        choices=export_sections.COORDINATES,
        help="of the sections: points of the surface, or axial position, radius and angles (else cartesian)",
    )
    parser.add_argument(
        "--samples",
        default=100,
        type=int,
        metavar="N",
        help="instants in the revolution, at most one for each element of the coating (default 100)",
    )
    inputs.add_to(parser)
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def export(options: argparse.Namespace) -> None:
    """Write what the command line asks for, and print what was written.

    Raises
    ------
    ConfigError
        If the config is at fault.
    InputError
        If an option or a file is.
    """
    config = inputs.read_config(options)
    if options.speeds and not (options.calculix or options.fe_matrices):
        raise InputError("--speeds: goes with --calculix or --fe-matrices only")
    if options.matrix_format and not options.fe_matrices:
        raise InputError("--matrix-format: goes with --fe-matrices only")
    if options.vtu and not options.run:
        raise InputError("--vtu: needs --run, the run whose motion is written")
    if options.run and not options.vtu:
        raise InputError("--run: goes with --vtu only")
    if options.coordinates and not options.sections:
        raise InputError("--coordinates: goes with --sections only")
    if options.vtu:
        write, in_words = _motion, _in_words
    elif options.sections:
        write, in_words = export_sections.write, export_sections.in_words
    else:
        write, in_words = export_blade.write, export_blade.in_words
    figures = write(options, config)
    print(json.dumps(figures, indent=2) if options.json else in_words(figures))


def _motion(options: argparse.Namespace, config: dict[str, Any]) -> dict[str, Any]:
    """Write the motion of a run; return what was written."""
    inputs.require(options, samples=(1, config["contact"]["elements"]))
    if options.vtu.exists():
        raise InputError(f"--vtu {options.vtu}: is there already, must be a new folder")
    inputs.require_room("vtu", options.vtu)

    from bladerub.study.store import read_run

    try:
        run = read_run(options.run)
    except OSError as error:
        raise InputError(f"--run {errors.message_for(error)}") from error
    path, blade = _blade(options, config)

    from bladerub.export.vtu import COLLECTION, read_mesh, write_motion
    from bladerub.io.provenance import provenance

    try:
        mesh = read_mesh(path.with_name("mesh.h5"), blade)
    except OSError as error:
        raise InputError(errors.message_for(error)) from error
    plan = _plan(options, config, run, path)
    recording = _record(options, run, plan, blade)
    about = {
        name: run.attributes[name] for name in ("casing", "E", "K", "theta", "law", "f_omega", "run_key")
    }
    try:
        largest = write_motion(options.vtu, mesh, recording, about | provenance(config))
    except OSError as error:
        raise InputError(f"--vtu {options.vtu}: cannot be written ({error})") from error
    return {
        "collection": str(options.vtu / COLLECTION),
        "samples": options.samples,
        "revolution": recording.revolution_peak.size,
        "nodes": len(mesh["points"]),
        "elements": len(mesh["cells"]),
        "largest_displacement": largest,
        "bytes": sum(file.stat().st_size for file in options.vtu.iterdir()),
    }


def _blade(options: argparse.Namespace, config: dict[str, Any]) -> tuple[Path, ReducedBlade]:
    path = inputs.blade_path(options, config)
    if not path.exists():
        raise InputError(f"{path}: is missing; name the blade of the run with --blade, or its --config")
    return inputs.read_blade(options, config)


def _plan(options: argparse.Namespace, config: dict[str, Any], run: StoredRun, blade: Path) -> PlannedRun:
    from bladerub.study.cache import blade_digest
    from bladerub.study.plan import claimed_run

    try:
        plan = claimed_run(config, options.run.name, run)
    except KeyError as error:
        raise InputError(
            f"--run {options.run}: {error} is not known; must be a run of this config"
        ) from error
    except (TypeError, ValueError) as error:
        raise InputError(f"--run {options.run}: its attributes are not those of a run ({error})") from error
    if plan.key(blade_digest(blade)) != run.attributes["run_key"]:
        raise InputError(
            f"--run {options.run}: is not of this config, the blade {blade} and this version of the solver "
            "(its run_key differs); name those of the run with --config and --blade, or compute it anew"
        )
    return plan


def _record(options: argparse.Namespace, run: StoredRun, plan: PlannedRun, blade: ReducedBlade) -> Recording:
    from bladerub.contact.recording import record
    from bladerub.contact.setup import compile_kernel

    peak = run.data["revolution_peak"]
    last = plan.spec.revolutions
    if run.attributes["status"] == "unbounded":
        last = np.count_nonzero(np.isfinite(peak)) - 1
    if last == 0:
        raise InputError(
            f"--run {options.run}: left all bounds in its first revolution, there is none to show"
        )
    compile_kernel()
    with tqdm(total=last, unit="rev", ncols=get_terminal_size().columns, disable=None, leave=False) as bar:
        recording = record(
            blade, plan.spec, last, options.samples, progress=lambda done: bar.update(done - bar.n)
        )
    difference = np.max(np.abs(recording.revolution_peak - peak[:last]))
    if not difference <= SAME * np.max(peak[:last]):
        raise InputError(
            f"--run {options.run}: computed again, its peaks differ by {difference:.2g} m: it was made on "
            "another kind of machine or with other packages; compute it here with bladerub run --output"
        )
    return recording


def _in_words(figures: dict[str, Any]) -> str:
    return "\n".join(
        [
            f"{figures['samples']} instants of revolution {figures['revolution']}, "
            f"{figures['nodes']} nodes, {figures['elements']} elements, {figures['bytes'] / 1e6:.3g} MB",
            f"largest displacement {figures['largest_displacement'] * 1e3:.4g} mm",
            f"open {figures['collection']} in ParaView",
        ]
    )
