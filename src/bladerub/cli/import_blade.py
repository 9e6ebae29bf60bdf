"""``bladerub import``: look at a blade from another program before its study."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import yaml

from bladerub.blade.model import ReducedBlade
from bladerub.blade.sources import origin
from bladerub.blade.sources.frame import ANGLE_UNITS, AXES, UNITS, Frame
from bladerub.blade.sources.origin import MATRIX_UNITS, MatrixSource, Source
from bladerub.cli import import_matrices, inputs
from bladerub.cli.errors import InputError
from bladerub.io.sources import ROOT

_AXIS_OPTIONS = ("--rotation", "--downstream", "--radial")
_FEWEST_SPEEDS = 5
_NAMES = (
    *("unit", "angle_unit", "rotation", "downstream", "radial", "root_set", "tip_set", "tip_cone"),
    *("matrix_units", "omega_max"),
)


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "import",
        help="look at a blade from another program before its study",
        description="Read a mesh and find its root, tip and interface nodes, or mesh the sections of a table "
        "with the numbers of elements of the config, or read the matrices and the list of nodes in a folder; "
        "reduce the blade as the config says, and tell what comes out and what to be wary of. Nothing is "
        "written. What it prints last goes into a config, whose study is then of that blade. Material (but "
        "of matrices) and reduction are of the config; the other options are what "
        "blade.source of the config says, or else as given here.",
    )
    parser.set_defaults(command=import_blade)
    parser.add_argument(
        "file",
        type=Path,
        metavar="PATH",
        help="mesh (.inp, .msh or .vtu), sections (.csv, .txt or .dat) or folder of matrices",
    )
    inputs.add_config_to(parser)
    parser.add_argument("--unit", choices=tuple(UNITS), help="unit of length in the file (else m)")
    parser.add_argument(
        "--angle-unit", choices=tuple(ANGLE_UNITS), help="unit of theta1 and theta2 of sections (else rad)"
    )
    for name, meaning in (
        ("rotation", "the blade turns about this by the right-hand rule (else -x)"),
        ("downstream", "the air flows along this (else x)"),
        ("radial", "the blade stands along this (else z)"),
    ):
        parser.add_argument(f"--{name}", choices=AXES, metavar="AXIS", help=f"axis of the file: {meaning}")
    parser.add_argument("--root-set", metavar="NAME", help="set of the clamped nodes (else found)")
    parser.add_argument("--tip-set", metavar="NAME", help="set of the nodes of the tip (else found)")
    parser.add_argument(
        "--tip-cone",
        type=float,
        metavar="DEGREES",
        help="half angle of the casing, positive where it widens downstream (else fitted to the tip)",
    )
    parser.add_argument("--matrix-units", choices=tuple(MATRIX_UNITS), help="of the matrices (else SI)")
    parser.add_argument(
        "--omega-max",
        type=float,
        metavar="RAD_PER_S",
        help="speed of stiffness_max, to be checked against reduction.f_omega_max",
    )
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def joined(arguments: list[str]) -> list[str]:
    """Write ``--downstream -z`` as ``--downstream=-z``: argparse takes a word with a minus for an option."""
    words = []
    for word in arguments:
        if words and words[-1] in _AXIS_OPTIONS and word in AXES:
            words[-1] += f"={word}"
        else:
            words.append(word)
    return words


def import_blade(options: argparse.Namespace) -> None:
    """Look at the blade that the command line names, and print what it is.

    Raises
    ------
    ConfigError
        If the config is at fault.
    InputError
        If the file or an option is, or the blade has no equilibrium.
    """
    config = inputs.read_config(options)
    given = {name: getattr(options, name) for name in _NAMES if getattr(options, name) is not None}
    kind = "matrices" if options.file.is_dir() else "file"
    path = options.file.resolve()
    named = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path  # as configs name it
    entry = {kind: str(named)} | asdict(Frame())
    known = config["blade"].get("source", {})
    entry |= {name: value for name, value in known.items() if name not in ("file", "matrices")} | given

    from bladerub.blade.rotation import EquilibriumError
    from bladerub.study.similarity import contact_scale, tip_stiffness

    try:
        source = origin.read(entry)
        if isinstance(source, MatrixSource):
            (figures, reduced), in_words = import_matrices.look(source, config), import_matrices.in_words
        else:
            (figures, reduced), in_words = _look(source, config), _in_words
    except (ValueError, EquilibriumError) as error:
        raise InputError(str(error)) from error
    length = round(figures["length"], 6)
    scale = contact_scale(replace(reduced, length=length))
    figures["tip_stiffness"] = tip_stiffness(reduced)
    figures["config"] = {
        "blade": {"length": length, "source": entry},
        "contact": {"scale": {name: float(f"{factor:.6g}") for name, factor in scale.items()}},
    }
    printed = (
        json.dumps(figures, indent=2) if options.json else "\n".join([*in_words(figures), *_ending(figures)])
    )
    print(printed)


def _look(source: Source, config: dict[str, Any]) -> tuple[dict[str, Any], ReducedBlade]:
    """Import and reduce the mesh of `source`; return the figures and the reduced blade."""
    # with fewer, all speeds of the table are those of the fit, where eq. (2) is exact
    config["reduction"]["accuracy_speeds"] = max(_FEWEST_SPEEDS, config["reduction"]["accuracy_speeds"])

    from bladerub.blade.build import reduce_meshed
    from bladerub.blade.elasticity import Material
    from bladerub.blade.sources import importing
    from bladerub.blade.sources.report import mesh_report

    imported = importing.import_blade(source, config["blade"]["mesh"])
    built = reduce_meshed(imported.blade, config)
    figures = mesh_report(source, imported, built, Material.from_config(config["blade"]["material"]))
    return figures, built.reduced


def _in_words(figures: dict[str, Any]) -> list[str]:
    millimetres = {name: [1e3 * end for end in ends] for name, ends in figures["extents"].items()}
    worst = [max(figures[name][:6]) for name in ("error_eq2", "error_reduced_model")]
    return [
        f"mesh                {figures['elements']} {figures['element']}, {figures['nodes']} nodes, "
        f"{figures['unknowns']} unknowns, {figures['elements_root_to_tip']} elements from root to tip",
        *(f"{name:<19} {low:.4g} to {high:.4g} mm" for name, (low, high) in millimetres.items()),
        f"length              {1e3 * figures['length']:.4g} mm, chord at the tip "
        f"{1e3 * figures['tip_chord']:.4g} mm, cone there {round(figures['tip_cone_degrees'], 6):g} degrees",
        f"root and tip        {figures['root_nodes']} and {figures['tip_nodes']} nodes; interface nodes up "
        f"to {1e3 * figures['interface_offset']:.3g} mm from their even places on the camber line",
        f"volume and mass     {1e6 * figures['volume']:.4g} cm³, {figures['mass']:.4g} kg",
        f"worst Jacobian      {figures['worst_jacobian']:.3g} (smallest over largest in an element)",
        f"first frequency     {figures['f1_hz']:.6g} Hz, times {figures['campbell_ratio']:.4g} at f_omega = "
        f"{figures['f_omega_max']:g}, where rotation moves the blade by "
        f"{1e3 * figures['centrifugal_displacement']:.3g} mm",
        f"reduced model       {figures['reduced_coordinates']} coordinates; in six modes eq. (2) is up to "
        f"{100 * worst[0]:.2g} % off, with the reduction {100 * worst[1]:.2g} %",
        *_sections_in_words(figures),
    ]


def _ending(figures: dict[str, Any]) -> list[str]:
    return [
        f"stagger at the tip  {abs(figures['tip_stagger_degrees']):.4g} degrees, the leading edge "
        f"{'ahead' if figures['tip_stagger_degrees'] >= 0 else 'behind'} in rotation",
        f"tip stiffness       {figures['tip_stiffness']:.4g} N/m, static",
        *(f"warning             {line}" for line in figures["warnings"]),
        "",
        "# for the config of its study; without contact.scale the values of the contact are absolute",
        yaml.safe_dump(figures["config"], sort_keys=False).rstrip(),
    ]


def _sections_in_words(figures: dict[str, Any]) -> Iterator[str]:
    if "sections" in figures:
        hub, *_, tip = figures["sections"]
        chords, thicknesses = (
            f"{1e3 * hub[name]:.4g} to {1e3 * tip[name]:.4g} mm" for name in ("chord", "thickness")
        )
        yield (
            f"sections            {len(figures['sections'])}, {hub['name']} to {tip['name']}: chord "
            f"{chords}, largest thickness {thicknesses}"
        )
