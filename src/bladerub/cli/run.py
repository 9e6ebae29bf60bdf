"""``bladerub run``: one simulation and a summary of it."""

import argparse
import os
import time
from collections.abc import Collection
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from bladerub.cli import inputs
from bladerub.cli.inputs import InputError, refused
from bladerub.config.errors import format_value
from bladerub.config.schema import check_quantity

_KINDS = {"abradable": ("E", "K", "theta", "friction"), "rigid": ("friction",)}
"""Options of each kind of coating; an abradable one has either theta or friction."""


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "run",
        run,
        help="run one simulation",
        description="Simulate contact at one speed with one coating, or with the rigid casing. Coating and "
        "speed need not be in the config. The blade is built first if the results folder has none.",
    )
    parser.option("--casing", "name of a casing of the config, such as 2nd", required=True)
    text = "abradable, with E, K and theta or friction (default), or rigid, with friction"
    parser.option("--coating", text, choices=list(_KINDS), default="abradable")
    parser.option("--E", "Young modulus of the abradable coating (normalised)", float)
    parser.option("--K", "plastic modulus of the abradable coating (normalised)", float)
    parser.option("--theta", "angle of its elements, rad (default 0): direction of the contact force", float)
    text = "coefficient of Coulomb friction, instead of --theta, or on the rigid casing (default 0)"
    parser.option("--friction", text, float, metavar="MU")
    parser.option("--f", "speed (normalised)", float, required=True, metavar="F_OMEGA")
    parser.option("--revolutions", "instead of solver.revolutions, at least 2", int, metavar="N")
    parser.option("--output", "write the run with its whole history (HDF5)", Path, metavar="FILE")


def run(options: argparse.Namespace) -> None:
    """Run the simulation that the command line asks for, and print its summary."""
    config = _config(options)
    _check_options(options, config)
    blade_path, blade = inputs.read_blade(options, config)

    from bladerub.contact.run import simulate
    from bladerub.contact.setup import compile_kernel
    from bladerub.io.provenance import provenance
    from bladerub.study.cache import blade_digest
    from bladerub.study.grid import CoatingCase, run_spec
    from bladerub.study.plan import planned_run
    from bladerub.study.store import stored_run, write_run
    from bladerub.study.summary import summarise

    if options.f > blade.f_omega_max:
        raise InputError(
            f"--f = {options.f:g}: must be at most {blade.f_omega_max:g} (normalised), the highest speed of "
            f"{blade_path}"
        )
    if options.coating == "rigid":
        case = CoatingCase.rigid(options.casing, options.friction)
    elif options.theta is None:
        case = CoatingCase.coulomb(options.casing, options.E, options.K, options.friction)
    else:
        case = CoatingCase(options.casing, options.E, options.K, options.theta)
    spec = run_spec(config, case, options.f)
    compile_kernel()
    with inputs.progress_bar(spec.revolutions, "rev") as bar, refused(ValueError):
        start = time.perf_counter()
        result = simulate(blade, spec, progress=lambda done: bar.update(done - bar.n))
        seconds = time.perf_counter() - start
    figures = summarise(spec, result, config) | {"steps_per_second": result.n_steps / seconds}
    if options.output:
        plan = planned_run(config, spec, options.output.name, keep_history=True)
        key = plan.key(blade_digest(blade_path))
        stored = stored_run(case, spec, result, key, config["analysis"], keep_history=True)
        with refused(OSError, because=f"--output {options.output}: cannot be written: "):
            write_run(options.output, stored, provenance(config))
    inputs.show(options, figures, _in_words)


def _config(options: argparse.Namespace) -> dict[str, Any]:
    config = inputs.read_config(options)

    from bladerub.config.checks import most_revolutions

    if options.revolutions is not None:
        inputs.require(options, revolutions=(2, min(10_000, most_revolutions(config))))
        config["solver"]["revolutions"] = options.revolutions
        analysis, divergence = config["analysis"], config["analysis"]["divergence"]
        analysis["spectrum_revolutions"] = min(analysis["spectrum_revolutions"], options.revolutions)
        divergence["revolutions"] = min(divergence["revolutions"], options.revolutions)
    return config


def _check_options(options: argparse.Namespace, config: dict[str, Any]) -> None:
    if options.casing not in config["casings"]:
        raise InputError(
            f"--casing = {format_value(options.casing)}: {_one_of(options.casing, config['casings'])}"
        )
    _complete_coating(options)
    for option in (*_KINDS[options.coating], "f"):
        value = getattr(options, option)
        if value is not None:  # of theta and friction only one is given
            with refused(ValueError, because=f"--{option} = {value:g}: "):
                check_quantity("f_omega" if option == "f" else option, value)
    fastest = config["reduction"]["f_omega_max"]
    if not options.blade and options.f > fastest:  # of a blade that may not be built yet
        raise InputError(
            f"--f = {options.f:g}: must be at most reduction.f_omega_max = {fastest:g} (normalised)"
        )
    if options.output:
        _check_output(options.output)


def _one_of(name: str, known: Collection[str]) -> str:
    close = get_close_matches(name, known, n=1)
    return f"must be one of {', '.join(known)}" + (f"; did you mean {close[0]}?" if close else "")


def _complete_coating(options: argparse.Namespace) -> None:
    """Fill in the defaults of the coating; an option of the other kind is an error."""
    if options.coating == "rigid":
        for option in ("E", "K", "theta"):
            given = getattr(options, option)
            if given is not None:
                raise InputError(f"--{option} = {given:g}: goes with --coating abradable only")
        options.friction = options.friction or 0.0
        return
    for option in ("E", "K"):
        if getattr(options, option) is None:
            raise InputError(f"--{option}: missing, an abradable coating needs it")
    if options.friction is None:
        options.theta = options.theta or 0.0
    elif options.theta is not None:
        raise InputError(f"--friction = {options.friction:g}: goes without --theta, which says the same")


def _check_output(path: Path) -> None:
    """Check that a run can be written to `path`, and that nothing but a run is replaced."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError):
        inputs.require_writable("output", path)
        return
    except OSError as error:
        raise InputError(f"--output {path}: cannot be written ({error.strerror})") from error
    if path.is_dir():
        raise InputError(f"--output {path}: is a folder, must be a file")
    if not _is_run(path):
        raise InputError(f"--output {path}: is there and is no run, must be a new file or a run to replace")
    inputs.require_writable("output", path)


def _is_run(path: Path) -> bool:
    from bladerub.io.hdf5 import read_attributes

    try:
        return path.is_file() and "run_key" in read_attributes(path)
    except OSError:
        return False


def _in_words(figures: dict[str, Any]) -> str:
    order = figures["engine_order"]
    rows = {
        "peak amplitude": f"{figures['peak_amplitude'] * 1e3:.4g} mm",
        "engine order": "none" if order is None else f"{order:.4g}",
        "maximum wear": f"{figures['max_wear'] * 1e3:.4g} mm",
        "lobes": figures["lobes"],
        "growth": _growth_in_words(figures),
        "saturating": "yes" if figures["saturating"] else "no",
        "divergent": "yes" if figures["divergent"] else "no",
        "status": figures["status"],
        "steps": figures["n_steps"],
        "steps per second": f"{figures['steps_per_second']:.3g}",
    }
    return "\n".join(inputs.aligned(rows.items()))


def _growth_in_words(figures: dict[str, Any]) -> str:
    growth, low, high = (figures[f"growth_{name}"] for name in ("per_revolution", "low", "high"))
    if growth is None:
        return "not measurable"
    interval = "" if low is None else f" (between {100 * low:.3g} and {100 * high:.3g} %)"
    return f"{100 * growth:.3g} % a revolution{interval}"
