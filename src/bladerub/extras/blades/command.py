"""``bladerub import``: check a blade from another program before its study."""

import argparse
import os
import sys
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import yaml

from bladerub.cli import inputs
from bladerub.config import read as configuration
from bladerub.config.files import Located
from bladerub.config.keys import key_of
from bladerub.config.problems import problems
from bladerub.config.quantities import converted
from bladerub.extras.blades import deck, origin, section_table, settings
from bladerub.extras.blades.origin import Frame
from bladerub.io.errors import BadInput
from bladerub.io.folders import base_config, study_folder

if TYPE_CHECKING:  # load numba, NumPy
    from bladerub.blade.model import ReducedBlade
    from bladerub.settings.fields import Section
    from bladerub.settings.study import Config

_FEWEST_SPEEDS = 5
_PLACES = ("file", "matrices")  # keys of ``blade.source`` that the path stands for


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "import",
        import_blade,
        blade=False,
        help="check a blade from another program before its study",
        description="Read a mesh and find its root, tip and interface nodes, or mesh the sections of a table "
        "with the numbers of elements of the config, or read a folder with matrices and a list of nodes. "
        "Reduce the blade as the config says, and report its properties and warnings. Nothing is written but "
        "the reduced blade, into the cache of this user, from which its study takes it. "
        "The last lines printed go into a config, whose study is then of that blade. Material (not for "
        "matrices) and reduction are those of the config; the material in a deck (.inp) "
        "replaces that of the study. The other options default to blade.source of the "
        "config, and if that has none to the values given here.",
    )
    text = "mesh (.inp, .msh or .vtu), sections (.csv, .txt or .dat) or folder of matrices"
    parser.add_argument("file", type=Path, metavar="PATH", help=text)
    text = "nominal speed of the rotor, revolutions a minute (default: figures.nominal_speed of the config)"
    parser.option("--rpm", text, inputs.number, metavar="N")
    for name, key in key_of(settings.Source).fields().items():
        if name not in _PLACES:
            option, text = f"--{name.replace('_', '-')}", key.description.replace("%", "%%")
            kind, metavar = (inputs.quantity, key.unit.name) if key.kind == "a number" else (None, None)
            parser.option(option, text, kind, choices=key.choices or None, metavar=metavar)


def import_blade(options: argparse.Namespace) -> None:
    """Read and reduce the blade that the command line names, and print its properties."""
    path = Path(os.path.realpath(options.file))  # Path.resolve fails where links form a circle
    kind = "matrices" if path.is_dir() else "file"
    if kind == "file":  # what is plainly no blade is refused before anything that takes seconds to import
        with inputs.refused(ValueError, because=f"{path}: "):
            origin.check_file(path)
            if path.suffix.lower() in origin.TABLE_SUFFIXES:
                section_table.read_cells(path)
    config = inputs.read_config(options)
    folder = study_folder()
    entry_path = path.relative_to(folder) if path.is_relative_to(folder) else path  # as configs name it
    in_config = config.blade.plain().get("source", {})
    values = {name: getattr(options, name, None) for name in settings.Source.model_fields}
    values = {name: value for name, value in values.items() if value is not None}
    values = in_config | converted(Located.of(values), settings.Source)[0].plain()
    entry = {kind: str(entry_path)} | asdict(Frame())
    entry |= {name: value for name, value in values.items() if name not in _PLACES}

    nominal = config.figures.nominal_speed if options.rpm is None else options.rpm
    figure_settings = config.figures.plain() | ({} if options.rpm is None else {"nominal_speed": nominal})
    for line in (*problems(entry, settings.Source), *problems(figure_settings, type(config.figures))):
        name, _, wrong = line.partition(" ")
        raise BadInput(f"--{name.replace('nominal_speed', 'rpm').replace('_', '-')} {wrong}")
    config = config.replaced("blade.source", settings.Source.model_construct(**entry))
    with inputs.refused(ValueError):
        origin.check(config.blade.source)

    from bladerub.extras.blades.similarity import contact_scale, tip_stiffness

    with inputs.refused(ValueError):
        figures, reduced = _read_blade(config, nominal)
    figures["tip_stiffness"] = tip_stiffness(reduced)
    study = configuration.read(base_config())
    blade = {"length": reduced.length, "source": entry}
    if "material" in figures:
        blade["material"] = figures["material"]
    if "sections" in figures and (mesh := _changed(config.blade.mesh, study.blade.mesh)):
        blade["mesh"] = mesh
    scale = {name: float(f"{factor:.6g}") for name, factor in contact_scale(reduced).items()}
    figures["config"] = {"blade": blade, "contact": {"scale": scale}}
    if reduction := _changed(config.reduction, study.reduction):
        figures["config"]["reduction"] = reduction
    if nominal is not None:
        figures["config"]["figures"] = {"nominal_speed": nominal}
    inputs.show(options, figures, _in_words)


def _changed(group: "Section", of_study: "Section") -> dict[str, Any]:
    """Values that are not those of the study, which the printed config has to give as well."""
    study_values = of_study.plain()
    return {name: value for name, value in group.plain().items() if value != study_values.get(name)}


def _read_blade(config: "Config", nominal: float | None) -> "tuple[dict[str, Any], ReducedBlade]":
    """Import, reduce and keep the blade of `config`; return the figures and the reduced blade."""
    from bladerub.blade.build import reduce_given, reduce_meshed
    from bladerub.blade.model import n_interface
    from bladerub.extras.blades import importing, matrices, report

    if config.blade.source.matrices:
        imported = matrices.import_matrices(config.blade.source, config.reduction)
        config = config.replaced("blade.length", round(imported.blade.layout.length, 6))
        built = reduce_given(imported.blade, config)
        importing.keep(built, config)
        return report.matrix_report(config.blade.source, imported, built, nominal), built.reduced

    # with fewer, all speeds of the table are those of the fit, where eq. (2) is exact
    speeds = max(_FEWEST_SPEEDS, config.reduction.accuracy_speeds)
    config, doubt = _take_material(config.replaced("reduction.accuracy_speeds", speeds))
    source, material = config.blade.source, config.blade.material
    imported = importing.import_blade(source, config.blade.mesh, n_interface(config))
    if sys.stderr.isatty():  # a fine mesh takes minutes
        nodes = len(imported.blade.mesh.mesh.points)
        print(f"bladerub import: reducing a mesh of {nodes} nodes at {speeds} speeds", file=sys.stderr)
    config = config.replaced("blade.length", round(imported.blade.length, 6))
    built = reduce_meshed(imported.blade, config)
    importing.keep(built, config)
    figures = report.mesh_report(source, imported, built, material, nominal) | {"material": material.plain()}
    figures["warnings"] = [*filter(None, [doubt]), *figures["warnings"]]
    return figures, built.reduced


def _take_material(config: "Config") -> "tuple[Config, str | None]":
    """Put the material of a deck into `config` in place of the study's; return what is to be said as well."""
    in_config, source = config.blade.material, config.blade.source
    used = f"the material of the config is used, {_of_material(in_config.plain())}"
    try:
        in_file = deck.material(origin.path(source), origin.frame(source).unit)
    except ValueError as error:
        return config, f"{used}; not that of the file: {error}"
    if in_file in (None, in_config):
        return config, None
    if in_config == configuration.read(base_config()).blade.material:
        return config.replaced("blade.material", in_file), None
    return config, f"{used}; the file has another, {_of_material(in_file.plain())}"


def _of_material(material: dict[str, float]) -> str:
    return "{young_modulus:g} Pa, {poisson_ratio:g}, {density:g} kg/m³".format(**material)


def _of_mesh(blade: SimpleNamespace) -> dict[str, str]:
    """Describe what a mesh or sections alone have, by name."""
    rows = {
        "root and tip": f"{blade.root_nodes} and {blade.tip_nodes} nodes; interface nodes up to "
        f"{1e3 * blade.interface_offset:.3g} mm from their even places on the camber line",
        "volume and mass": f"{1e6 * blade.volume:.4g} cm³, {blade.mass:.4g} kg",
        "material": _of_material(blade.material),
        "worst Jacobian": f"{blade.worst_jacobian:.3g} (smallest over largest in an element)",
    }
    if hasattr(blade, "sections"):
        hub, *_, tip = blade.sections
        names, sizes = f"{len(blade.sections)}, {hub['name']} to {tip['name']}", ("chord", "thickness")
        chords, widths = (f"{1e3 * hub[name]:.4g} to {1e3 * tip[name]:.4g} mm" for name in sizes)
        rows["sections"] = f"{names}: chord {chords}, largest thickness {widths}"
    return rows


def _of_matrices(blade: SimpleNamespace) -> dict[str, str]:
    """Describe what matrices alone have, by name."""
    places = [", ".join(f"{1e3 * x:.4g}" for x in blade.interface[end]) for end in (0, -1)]
    omission = "" if blade.mass_is_whole else " without that of the clamped nodes, whose rows are not there"
    return {
        "clamped and tip": f"{blade.clamped_nodes} and {blade.tip_nodes} nodes",
        "interface": "from ({}) to ({}) mm, leading to trailing edge".format(*places),
        "mass": f"{blade.mass:.4g} kg{omission}",
        "speeds": f"f_omega = {', '.join(f'{speed:g}' for speed in blade.speeds)}; the highest is "
        f"{blade.omega_max:.6g} rad/s",
    }


def _in_words(figures: dict[str, Any]) -> str:
    from bladerub.extras.blade_doubts import percent

    blade = SimpleNamespace(**figures)
    size, length = f"{blade.nodes} nodes, {blade.unknowns} unknowns", f"{1e3 * blade.length:.4g} mm"
    if "elements" in figures:
        along = f"{blade.elements_root_to_tip} elements from root to tip"
        rows = {"mesh": f"{blade.elements} {blade.element}, {size}, {along}"}
        length += f", chord at the tip {1e3 * blade.tip_chord:.4g} mm, cone there"
        particular = _of_mesh(blade)
        moved = f", where rotation moves the blade by {1e3 * blade.centrifugal_displacement:.3g} mm"
    else:
        rows = {"matrices": size}
        length += f"{'' if blade.length_is_measured else ' that its nodes reach over'}, cone at the tip"
        particular, moved = _of_matrices(blade), ""
    rows |= {name: f"{1e3 * low:.4g} to {1e3 * high:.4g} mm" for name, (low, high) in blade.extents.items()}
    rows |= {"length": f"{length} {round(blade.tip_cone_degrees, 3) + 0.0:g} degrees"} | particular
    law = "eq. (2) is exact at the speeds of the files"
    if blade.error_eq2 is not None:
        law = f"eq. (2) is up to {percent(max(blade.error_eq2[:6]))} % off"
    stagger, lean = blade.tip_stagger_degrees, blade.tip_lean
    crossings = ", ".join(f"eo({crossing['order']}) {crossing['rpm']:.0f}" for crossing in blade.crossings)
    crossings = f", 1/min: {crossings}" if crossings else ": none within reduction.f_omega_max"
    rows |= {
        "first frequency": f"{blade.f1_hz:.6g} Hz, times {blade.campbell_ratio:.4g} at f_omega = "
        f"{blade.f_omega_max:g}{moved}",
        "reduced model": f"{blade.reduced_coordinates} coordinates; in six modes {law}, with the reduction "
        f"{percent(max(blade.error_reduced_model[:6]))} %",
        "stagger at the tip": f"{abs(stagger):.4g} degrees, the leading edge "
        f"{'ahead' if stagger >= 0 else 'behind'} in rotation",
        "first mode": f"u_r/u_t at the tip {lean[0]:.3f} at the leading edge, {lean[-1]:.3f} at the trailing "
        "edge",
        "crossings": f"of mode 1{crossings}",
        "tip stiffness": f"{blade.tip_stiffness:.4g} N/m, static",
    }
    if blade.nominal_speed:
        rows["nominal speed"] = f"{blade.nominal_speed:g} 1/min, f_omega = {blade.nominal_f_omega:.4g}"
    lines = inputs.aligned([*rows.items(), *(("warning", line) for line in blade.warnings)])
    note = "# for the config of its study; without contact.scale the values of the contact are absolute"
    return "\n".join([*lines, "", note, yaml.safe_dump(blade.config, sort_keys=False).rstrip()])
