"""``bladerub run``: one simulation and a summary of it."""

import argparse
import math
import sys
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from bladerub import plugins
from bladerub.cli import inputs
from bladerub.cli.inputs import Parser, quantity, refused
from bladerub.io.errors import BadInput
from bladerub.settings.units import doubted_modulus, speed_in_words

if TYPE_CHECKING:  # as in `inputs`
    from bladerub.api.blade import Blade
    from bladerub.api.planned import StudyRun
    from bladerub.api.run import Run
    from bladerub.api.study import Study
    from bladerub.settings.study import Config

_QUANTITIES = ("E", "K", "theta", "friction", "damping_ratio", "layer_thickness", "interference")
_STEEP = math.pi / 4  # beyond this angle the force is more tangential than normal
_UNITS = (
    {"theta": "rad", "f_omega": "f1 at rest", "modulus_unit": "Pa", "rpm": "1/min"}
    | dict.fromkeys(("E", "K"), "contact.modulus_unit")
    | dict.fromkeys(("peak_amplitude", "max_wear", "layer_thickness", "interference"), "m")
    | dict.fromkeys(("displacement_over_length", "growth_per_revolution", "damping_ratio"), "1")
)


class RunOption:
    """What ``bladerub run`` can be asked for besides (``RUN_OPTIONS``); each step does nothing by default."""

    units: ClassVar[Mapping[str, str]] = {}  # of the figures that it adds

    def add_to(self, parser: Parser) -> None:
        """Add the options to those of the command."""

    def check(self, options: argparse.Namespace, config: "Config") -> None:
        """Check and convert the options; raises `bladerub.io.errors.BadInput`."""

    def vary(self, options: argparse.Namespace, study: "Study") -> "Study":
        """Return the study as the options change it."""
        return study

    def arguments(self, options: argparse.Namespace) -> dict[str, Any]:
        """Return what `bladerub.simulate` is given besides."""
        return {}

    def figures(
        self, options: argparse.Namespace, planned: "StudyRun", blade: "Blade", run: "Run"
    ) -> dict[str, Any]:
        """Return what is reported of the `run` besides its own figures."""
        return {}

    def in_words(self, figures: Mapping[str, Any]) -> list[str]:
        """Write these of all figures as lines; none if they are not there."""
        return []


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "run",
        run,
        help="run one simulation",
        description="Simulate contact at one speed with one coating, or with the rigid casing. Coating and "
        "speed need not be in the config. A run that grows is followed further, as in the study. The "
        "blade is built first if the results folder has none.",
    )
    inputs.add_trust_to(parser)
    parser.option("--casing", "name of a casing of the config, such as 2nd", required=True)
    text = "abradable, with E, K and theta or friction (default), or rigid, with friction"
    parser.option("--coating", text, choices=["abradable", "rigid"], default="abradable")
    parser.option("--E", "Young modulus of the abradable coating: normalised, or '1.2 GPa'", quantity)
    parser.option("--K", "plastic modulus of the abradable coating: likewise", quantity)
    text = "angle of its elements, rad or '8 deg' (default 0): direction of the contact force"
    parser.option("--theta", text, quantity)
    text = "coefficient of Coulomb friction, instead of --theta, or on the rigid casing (default 0)"
    parser.option("--friction", text, inputs.number, metavar="MU")
    text = "of every mode, instead of contact.damping_ratio"
    parser.option("--damping-ratio", text, quantity, metavar="XI")
    text = "instead of contact.layer_thickness: '4 mm', or in m times contact.scale.length"
    parser.option("--layer-thickness", text, quantity, metavar="H")
    text = "instead of that of the casing: '0.4 mm', or in m times contact.scale.length"
    parser.option("--interference", text, quantity, metavar="D")
    speed = parser.add_mutually_exclusive_group(required=True)
    text = "speed: normalised, or with a unit, such as 2200rpm or '38 Hz'"
    parser.option("--f", text, quantity, speed, metavar="F_OMEGA")
    parser.option("--rpm", "the same as --f 'N rpm'", inputs.number, speed, metavar="N")
    parser.option("--revolutions", "instead of solver.revolutions, at least 2", int, metavar="N")
    text = "what the run is computed on, instead of solver.device"
    parser.option("--device", text, choices=["cpu", *plugins.offered("SOLVERS")])
    parser.option("--output", "write the run with its whole history (HDF5)", Path, metavar="FILE")
    for name, option in _options().items():
        try:
            option.add_to(parser)
        except argparse.ArgumentError as error:
            raise plugins.refusal("RUN_OPTIONS", name, str(error)) from None


@cache
def _options() -> dict[str, RunOption]:
    options = plugins.loaded("RUN_OPTIONS")
    for name, option in options.items():
        if not (isinstance(option, type) and issubclass(option, RunOption)):
            reason = "must be a class as bladerub.cli.run.RunOption"
            raise plugins.refusal("RUN_OPTIONS", name, reason)
    return {name: option() for name, option in options.items()}


def run(options: argparse.Namespace) -> None:
    """Run the simulation that the command line asks for, and print its summary."""
    config = inputs.read_config(options)
    if options.device:
        config = config.replaced("solver.device", options.device)
    for option in _options().values():
        option.check(options, config)

    from bladerub.api.simulate import simulate
    from bladerub.api.study import Study
    from bladerub.blade.cache import kept_frequency
    from bladerub.study.solver import solver_of

    study, more = Study(config, inputs.study_folder()), {}
    for option in _options().values():
        study = option.vary(options, study)
        more |= option.arguments(options)
    if options.output:
        _check_output(options.output)
    by, speed = ("f", options.f) if options.rpm is None else ("rpm", f"{options.rpm:.15g} rpm")
    blade = None
    if options.blade:
        blade, config = inputs.read_blade(options, study.config)
        study = replace(study, config=config)
    with inputs.as_options(f_omega=by, speed=by):
        f_omega = blade.f_omega(speed) if blade else speed
        describe = study.rigid if options.coating == "rigid" else study.coating
        planned = describe(options.casing, **_coating_values(options)).at(f_omega, options.revolutions)
    fastest = blade.reduced.f_omega_max if blade else config.reduction.f_omega_max
    if planned.f_omega > fastest:  # before it is built
        typed = f" ({speed})" if isinstance(speed, str) else ""
        limit = speed_in_words(fastest, blade.f1_hz if blade else kept_frequency(config))
        raise BadInput(
            f"--{by} = {planned.f_omega:g}{typed}: must be at most reduction.f_omega_max = {limit}"
        )
    _point_out(options, planned)
    solver_of(config).check()
    blade = blade or inputs.read_blade(options, config)[0]
    with refused(ValueError, OSError), inputs.as_options(f_omega=by):
        result = simulate(blade, planned, **more)
    if options.output:
        with refused(OSError, because="--output cannot be written: "):
            result.write(options.output, config)
    figures = _figures(planned, blade, result)
    inputs.warn_of_residual(options, figures["energy_residual"])
    for name, option in _options().items():
        if added := option.figures(options, planned, blade, result):
            if taken := added.keys() & figures.keys():
                raise plugins.refusal("RUN_OPTIONS", name, f"figures: {min(taken)}: is a figure already")
            figures |= added
            figures["units"] |= option.units
    inputs.show(options, figures, _in_words)


def _coating_values(options: argparse.Namespace) -> dict[str, Any]:
    """Return the values of the coating that are given: those it needs, and none of another kind."""
    from bladerub.api.arguments import InputError

    given = {name: value for name in _QUANTITIES if (value := getattr(options, name)) is not None}
    if options.coating == "rigid":
        for name in ("E", "K", "theta", "layer_thickness"):
            if name in given:
                raise InputError(name, given[name], "goes with --coating abradable only")
    else:
        for name in ("E", "K"):
            if name not in given:
                raise BadInput(f"--{name}: missing, an abradable coating needs it")
    return given


def _point_out(options: argparse.Namespace, planned: "StudyRun") -> None:
    """Say on standard error what is allowed, but may not be meant."""
    theta = planned.case.theta
    if planned.case.law == "theta" and theta > _STEEP:
        ratio = f"the tangential part is {math.tan(theta):.2g} times the normal one"
        print(f"bladerub run: --theta = {theta:g}: in rad, of the contact force {ratio}", file=sys.stderr)
    modulus = 0.0 if planned.case.is_rigid else planned.case.E * planned.spec.coating.modulus_unit
    if doubt := doubted_modulus(modulus):
        print(f"bladerub run: --E = {planned.case.E:g}: {doubt}", file=sys.stderr)
    if options.output and not options.output.parent.exists():
        print(f"bladerub run: making the folder {options.output.parent}", file=sys.stderr)


def _figures(planned: "StudyRun", blade: "Blade", result: "Run") -> dict[str, Any]:
    from bladerub.study.store import datasets

    case, summary = planned.case, result.summary(planned.config)
    peak = summary["peak_amplitude"]
    return {
        "casing": case.casing,
        "E": None if case.is_rigid else case.E,
        "K": None if case.is_rigid else case.K,
        "theta": case.theta if case.law == "theta" else None,
        "friction": case.friction if case.law == "coulomb" else None,
        "damping_ratio": planned.spec.damping_ratio,
        "element_law": None if case.is_rigid else planned.spec.coating.element_law.label,
        "modulus_unit": None if case.is_rigid else planned.spec.coating.modulus_unit,
        "layer_thickness": None if case.is_rigid else planned.spec.coating.thickness,
        "interference": planned.spec.casing.interference,
        "f_omega": planned.f_omega,
        "revolutions": planned.spec.revolutions,
        "complete_revolutions": int(result.to_pandas().revolution_amplitude.count()),
        **summary,
        "run_key": result.attributes["run_key"],
        "units": _UNITS | {f"max_{name}": datasets()[name][1] for name in result.layer},
        "rpm": 60 * planned.f_omega * blade.f1_hz,
        "displacement_over_length": None if peak is None else peak / blade.length,
    }


def _check_output(path: Path) -> None:
    """Check that a run can be written to `path`, and that nothing but a run is replaced."""
    with (
        refused(OSError, because="--output cannot be written: "),
        suppress(FileNotFoundError, NotADirectoryError),
    ):
        path.lstat()
        if not _is_run(path):
            raise BadInput(f"--output {path}: is there and is no run, must be a new file or a run to replace")
    inputs.require_writable("--output", path)


def _is_run(path: Path) -> bool:
    from bladerub.io.hdf5 import read_attributes

    try:
        return path.is_file() and "run_key" in read_attributes(path)
    except OSError:
        return False


def _in_words(figures: dict[str, Any]) -> str:
    from bladerub.study.summary import worn_through

    order = figures["engine_order"]
    duration = f", after {figures['growth_revolutions']} revolutions"
    harmonic, share = figures["wear_harmonic"], f"{100 * figures['wear_harmonic_share']:.0f}"
    layer = {
        f"largest {name.removeprefix('max_').replace('_', ' ')}": f"{figures[name]:.3g} {unit}, at the end"
        for name, unit in figures["units"].items()
        if name.startswith("max_") and name != "max_wear"
    }
    rows = {
        "coating": _coating_in_words(figures),
        "contact": _contact_in_words(figures),
        **({"law": law} if (law := figures["element_law"]) not in (None, "plastic") else {}),
        "speed": f"{figures['f_omega']:.4g} (normalised), {figures['rpm']:,.0f} rpm",
        "peak displacement": "none, the first step left the displacement limit"
        if figures["peak_amplitude"] is None
        else f"{figures['peak_amplitude'] * 1e3:.4g} mm (radial, node 1, last revolutions)"
        + inputs.large_in_words(figures["displacement_over_length"]),
        "engine order": "none" if order is None else f"{order:.4g}",
        "maximum wear": f"{figures['max_wear'] * 1e3:.4g} mm"
        + worn_through(figures["max_wear"], figures["layer_thickness"]),
        **layer,
        "lobes": figures["lobes"],
        "strongest harmonic of the wear": f"{harmonic} ({share} % of the variance)" if harmonic else "none",
        "growth": _growth_in_words(figures),
        "saturating": ("yes" if figures["saturating"] else "no") + duration,
        "divergent": ("yes" if figures["divergent"] else "no") + duration,
        "status": _status_in_words(figures),
        "energy residual": f"{figures['energy_residual']:.2g} of the work exchanged",
        "steps": figures["n_steps"],
    }
    lines = inputs.aligned(rows.items())
    for option in _options().values():
        if more := option.in_words(figures):
            lines += ["", *more]
    return "\n".join(lines)


def _coating_in_words(figures: dict[str, Any]) -> str:
    """State the moduli in Pa, too."""
    if figures["modulus_unit"] is None:
        return "none, the casing is rigid"
    unit = figures["modulus_unit"] / 1e6
    return ", ".join(f"{name} = {figures[name]:g} ({figures[name] * unit:.4g} MPa)" for name in ("E", "K"))


def _contact_in_words(figures: dict[str, Any]) -> str:
    """State what decides the contact besides the moduli."""
    angle = f"μ = {figures['friction']:g}" if figures["theta"] is None else f"θ = {figures['theta']:g} rad"
    lengths = {"layer": figures["layer_thickness"], "interference": figures["interference"]}
    words = (f"{name} {1e3 * length:.4g} mm" for name, length in lengths.items() if length is not None)
    return ", ".join([angle, *words, f"ξ = {figures['damping_ratio']:g}"])


def _status_in_words(figures: dict[str, Any]) -> str:
    status, revolutions = figures["status"], figures["revolutions"]
    if status == "completed":
        return f"{status}, {revolutions} revolutions"
    return f"{status}, in revolution {figures['complete_revolutions'] + 1} of {revolutions}"


def _growth_in_words(figures: dict[str, Any]) -> str:
    growth, low, high = (figures[f"growth_{name}"] for name in ("per_revolution", "low", "high"))
    if growth is None:
        return "not measurable"
    interval = "" if low is None else f" (between {100 * low:.3g} and {100 * high:.3g} %)"
    return f"{100 * growth:.3g} % a revolution{interval}"
