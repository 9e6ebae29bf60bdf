"""``bladerub export``: a run or the blade for other programs."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bladerub.api.display import bar
from bladerub.cli import inputs
from bladerub.extras.bounds import require
from bladerub.extras.export import blade_command
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    from bladerub.blade.model import ReducedBlade
    from bladerub.extras.export.recording import Recording
    from bladerub.settings.study import Config
    from bladerub.study.plan import PlannedRun
    from bladerub.study.store import StoredRun

SAME = 1e-6
"""Largest relative difference of the peaks at which a run computed again counts as the run of the file."""

_MOTIONS = (
    ("--vtu", "DIR", "a new folder for blade.pvd and a .vtu for each instant"),
    ("--animation", "FILE", "a new GIF: blades, coating and wear over the whole run, seen along the axis"),
)
_GOES_WITH = {  # options that need one of others
    **dict.fromkeys(("samples", "run"), ("vtu", "animation")),
    **dict.fromkeys(("vtu", "animation"), ("run",)),
    "speeds": ("calculix", "fe_matrices"),
    "matrix_format": ("fe_matrices",),
    "coordinates": ("sections",),
}
_SUFFIXES = {
    "animation": (".gif",),
    "mesh": (".inp", ".msh", ".vtu"),
    "matrices": (".npz", ".mat"),
    "sections": (".csv", ".txt", ".dat"),
}


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "export",
        export,
        help="write the blade's motion in a run, or the blade itself, for other programs",
        description="With --vtu: compute a run again from its file, its config and its blade, and write the "
        "motion of the finite element mesh in its last revolution; of a row of blades, that of all, and the "
        "coating. With --animation: draw the blades and the wear at instants of the whole run. The run_key "
        "and the peaks of all revolutions show that it is the same run. With --calculix, --mesh, --matrices "
        "or --fe-matrices: write the blade, which is built first if the results folder has none. With "
        "--sections: write the sections of the config, for which no blade is built.",
        epilog="Open blade.pvd in ParaView and apply Warp By Vector to displacement. The mesh is the blade "
        "at rest in the rotating frame; displacement (m) is that of each node about its running position, "
        "without the centrifugal displacement; time is in revolutions from the start of the run. Of a run "
        "that exceeds the displacement limit, the last complete revolution is written.",
    )
    parser.option("--run", "the run (HDF5), for --vtu and --animation", Path, metavar="FILE")
    form = parser.add_mutually_exclusive_group(required=True)
    for option, metavar, text in (*_MOTIONS, *blade_command.FORMS):
        form.add_argument(option, type=Path, metavar=metavar, help=text)
    text = (
        "of the decks, normalised or '2200 rpm' (default: 0, half of and the highest of the reduced blade); "
        "with --fe-matrices, of a stiffness in addition to those at these three"
    )
    parser.option("--speeds", text, inputs.quantity, nargs="+", metavar="F_OMEGA")
    text = "of --fe-matrices: Matrix Market, or what scipy.sparse.load_npz reads (default mtx)"
    parser.option("--matrix-format", text, choices=("mtx", "npz"))
    text = "of the sections: points of the surface (default), or axial position, radius and angles"
    parser.option("--coordinates", text, choices=blade_command.COORDINATES)
    text = "instants in the revolution or the animation, at most one for each element (default 100)"
    parser.option("--samples", text, int, metavar="N")


def export(options: argparse.Namespace) -> None:
    """Write what the command line asks for, and print what was written."""
    config = inputs.read_config(options)
    for option, forms in _GOES_WITH.items():
        if getattr(options, option) is not None and not any(getattr(options, form) for form in forms):
            names = " or ".join(f"--{form.replace('_', '-')}" for form in forms)
            raise BadInput(f"--{option.replace('_', '-')}: goes with {names} only")
    for form, suffixes in _SUFFIXES.items():
        file = getattr(options, form)
        if file and file.suffix.lower() not in suffixes:
            raise BadInput(f"--{form} {file}: must end in {', '.join(suffixes)}")
        if file and file.exists():  # perhaps what somebody drew
            raise BadInput(f"--{form} {file}: is there already, must be a new file")
    forms = {"animation": _animation, "vtu": _motion, "sections": blade_command.write_sections}
    write = next((forms[form] for form in forms if getattr(options, form)), blade_command.write)
    figures, text = write(options, config)
    inputs.show(options, figures, lambda _: text)


def _motion(options: argparse.Namespace, config: "Config") -> tuple[dict[str, Any], str]:
    """Write the motion of a run; return what was written, also in words."""
    run, plan, blade, config = _run_of_file(options, config, "vtu")

    from bladerub.extras.export.mesh_file import COLLECTION, read_mesh, write_motion
    from bladerub.extras.stress.run import stress_of
    from bladerub.io.provenance import provenance

    with inputs.refused(OSError):
        mesh = read_mesh(blade.mesh_path, blade.reduced)
        stress = stress_of(blade.mesh_path, run.attributes["f_omega"]) if len(mesh["cells"]) else None
    recording = _record(options, run, plan, blade.reduced, whole=False)
    names = ("casing", "E", "K", "theta", "law", "f_omega", "run_key")
    about = {name: run.attributes[name] for name in names} | provenance(config.plain())
    with inputs.refused(OSError, because=f"--vtu {options.vtu}: cannot be written: "):
        largest = write_motion(options.vtu, mesh, recording, about, stress, plan.row)
    blades, revolution = recording.revolution_peak.shape
    nodes, elements = blades * len(mesh["points"]), blades * len(mesh["cells"])
    size = sum(file.stat().st_size for file in options.vtu.iterdir())
    displacement = largest["largest_displacement"]
    figures = {"collection": str(options.vtu / COLLECTION), "samples": options.samples}
    figures |= {"revolution": revolution, "blades": blades, "nodes": nodes, "elements": elements, **largest}
    figures |= {"displacement_over_length": displacement / blade.reduced.length, "bytes": size}
    stresses = "stress not known: a blade of matrices has no elements"
    if stress:
        place = ", ".join(f"{1e3 * x:.1f}" for x in largest["largest_von_mises_at"])
        stresses = (
            f"largest von Mises stress {largest['largest_von_mises'] / 1e6:.4g} MPa at ({place}) mm after "
            f"{largest['largest_von_mises_time']:.3f} revolutions, "
            f"largest principal stress {largest['largest_principal'] / 1e6:.4g} MPa"
        )
    return figures, (
        f"{options.samples} instants of revolution {revolution}, {nodes} nodes, {elements} elements"
        f"{f' of {blades} blades' if blades > 1 else ''}, {size / 1e6:.3g} MB\n"
        f"largest displacement {displacement * 1e3:.4g} mm"
        f"{inputs.large_in_words(figures['displacement_over_length'])}\n"
        f"{stresses}\nopen {figures['collection']} in ParaView"
    )


def _animation(options: argparse.Namespace, config: "Config") -> tuple[dict[str, Any], str]:
    """Write the animation of a run; return what was written, also in words."""
    path = options.animation
    run, plan, blade, _ = _run_of_file(options, config, "animation")

    from bladerub.extras.export.animation import animate
    from bladerub.extras.rows.spec import Row

    recording = _record(options, run, plan, blade.reduced, whole=True)
    with inputs.refused(OSError, because=f"--animation {path}: cannot be written: "):
        animate(path, recording, blade.reduced, plan.row or Row.even(1), run.attributes)
    blades, revolutions = recording.revolution_peak.shape
    wear, size = float(recording.wear.max()), path.stat().st_size
    figures = {"animation": str(path), "samples": options.samples, "revolutions": revolutions}
    return figures | {"blades": blades, "greatest_wear": wear, "bytes": size}, (
        f"{options.samples} instants of {revolutions} revolutions, {blades} blades, greatest wear "
        f"{1e3 * wear:.4g} mm: {path}, {size / 1e6:.3g} MB"
    )


def _run_of_file(options: argparse.Namespace, config: "Config", form: str) -> tuple:
    """Read a run whose motion is to be written, plan it again, read its blade; return them and its config."""
    if options.samples is None:
        options.samples = 100
    require(options, samples=(1, config.contact.elements))
    target = getattr(options, form)
    if target.exists():
        raise BadInput(f"--{form} {target}: is there already, must be a new folder")
    inputs.require_writable(f"--{form}", target)

    from bladerub.extras.export.recording import claimed_run
    from bladerub.study.cache import blade_digest
    from bladerub.study.store import read_runs

    with inputs.refused(OSError, because="--run "):
        run = read_runs(options.run)[""]
    path = inputs.blade_path(options, config)
    if not path.exists():
        raise BadInput(f"{path}: is missing; name the blade of the run with --blade, or its --config")
    blade, config = inputs.read_blade(options, config)
    try:
        plan = claimed_run(config, options.run.name, run)
    except KeyError as error:
        raise BadInput(f"--run {options.run}: {error} is not known; must be a run of this config") from error
    except (TypeError, ValueError) as error:
        raise BadInput(f"--run {options.run}: its attributes are not those of a run ({error})") from error
    if plan.key(blade_digest(path)) != run.attributes["run_key"]:
        raise BadInput(
            f"--run {options.run}: is not of this config, the blade {path} and this version of the solver "
            "(its run_key differs); name those of the run with --config and --blade, or compute it again"
        )
    return run, plan, blade, config


def _record(options, run: "StoredRun", plan: "PlannedRun", blade: "ReducedBlade", whole: bool) -> "Recording":
    """Record the last complete revolution of a run, or the `whole` of it up to there."""
    from bladerub.contact.setup import compile_kernel
    from bladerub.extras.export.recording import record

    last, n_elements = plan.spec.revolutions, plan.spec.coating.n_elements
    if run.attributes["status"] == "unbounded":
        last = int(np.count_nonzero(np.isfinite(run.data["revolution_amplitude"])))
    if last == 0:
        fault = "exceeds the displacement limit in its first revolution, so that no revolution is complete"
        raise BadInput(f"--run {options.run}: {fault}")
    before = 0 if whole else last - 1
    instants = np.rint(np.linspace(0, (last - before) * n_elements, options.samples + 1)[1:]).astype(int)
    compile_kernel(plan.spec.turns, blade.n_interface, plan.spec.coating.element_law)
    elements = (before * n_elements + instants).tolist()
    with bar(last, "rev", None) as line:
        recording = record(blade, plan.spec, plan.row, elements, lambda done: line.update(done - line.n))
    stored = run.data["revolution_peak"][:last]
    computed = recording.revolution_peak[run.attributes.get("blade", 1) - 1]  # whose peaks are stored
    difference = np.max(np.abs(computed - stored))
    if not difference <= SAME * np.max(stored):
        raise BadInput(
            f"--run {options.run}: computed again, its peaks differ by {difference:.2g} m: it was made on "
            "another kind of machine or with other packages; compute it here with bladerub run --output"
        )
    return recording
