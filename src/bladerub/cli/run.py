"""``bladerub run``: one simulation, summed up."""

from __future__ import annotations

import argparse
import json
import os
import time
from collections.abc import Collection
from difflib import get_close_matches
from pathlib import Path
from shutil import get_terminal_size
from typing import Any

from tqdm import tqdm

from bladerub.cli import inputs
from bladerub.cli.errors import InputError
from bladerub.config.errors import format_value
from bladerub.config.schema import check_quantity

_KINDS = {"abradable": ("E", "K", "theta", "friction"), "rigid": ("friction",)}
"""What describes each kind of coating; of theta and friction an abradable one has either."""


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "run",
        help="run one simulation",
        description="Let the blade rub at one speed on one coating, or on the rigid casing; neither need be "
        "in the config. "
        "The blade is built first if the results folder has none yet.",
    )
    parser.set_defaults(command=run)
    parser.add_argument("--casing", required=True, help="name of a casing of the config, such as 2nd")
    parser.add_argument(
        "--coating",
        choices=list(_KINDS),
        default="abradable",
        help="abradable, with E, K and theta or friction (default), or rigid, with friction",
    )
    parser.add_argument("--E", type=float, help="Young modulus of the abradable coating (normalised)")
    parser.add_argument("--K", type=float, help="plastic modulus of the abradable coating (normalised)")
    parser.add_argument(
        "--theta", type=float, help="angle of its elements, rad (default 0): a force of constant direction"
    )
    parser.add_argument(
        "--friction",
        type=float,
        metavar="MU",
        help="coefficient of Coulomb friction, instead of --theta, or on the rigid casing (default 0)",
    )
    parser.add_argument("--f", required=True, type=float, metavar="F_OMEGA", help="speed (normalised)")
    inputs.add_to(parser)
    parser.add_argument(
        "--revolutions", type=int, metavar="N", help="instead of solver.revolutions, at least 2"
    )
    parser.add_argument(
        "--output", type=Path, metavar="FILE", help="write the run with its whole history (HDF5)"
    )
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def run(options: argparse.Namespace) -> None:
    """Run the simulation that the command line asks for, and print what comes out.

    Raises
    ------
    ConfigError
        If the config is at problem.
    InputError
        If an option is.
    """
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
    with tqdm(
        total=spec.revolutions, unit="rev", ncols=get_terminal_size().columns, disable=None, leave=False
    ) as bar:
        start = time.perf_counter()
        try:
            result = simulate(blade, spec, progress=lambda done: bar.update(done - bar.n))
        except ValueError as error:
            raise InputError(str(error)) from error
        seconds = time.perf_counter() - start
    figures = summarise(spec, result, config) | {"steps_per_second": result.n_steps / seconds}
    if options.output:
        plan = planned_run(config, spec, options.output.name, keep_history=True)
        key = plan.key(blade_digest(blade_path))
        stored = stored_run(case, spec, result, key, config["analysis"], keep_history=True)
        try:
            write_run(options.output, stored, provenance(config))
        except OSError as error:
            raise InputError(f"--output {options.output}: cannot be written ({error})") from error
    print(json.dumps(figures, indent=2) if options.json else _in_words(figures))


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
        if value is None:  # theta beside friction, or friction beside theta
            continue
        try:
            check_quantity("f_omega" if option == "f" else option, value)
        except ValueError as error:
            raise InputError(f"--{option} = {value:g}: {error}") from error
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


def _check_output(path: Path) -> None:
    """See that a run can be written to `path`, and that nothing else is lost by it."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError):
        pass
    except OSError as error:
        raise InputError(f"--output {path}: cannot be written ({error.strerror})") from error
    if path.is_dir():
        raise InputError(f"--output {path}: is a folder, must be a file")
    if os.path.lexists(path) and not _is_run(path):
        raise InputError(f"--output {path}: is there and is no run, must be a new file or a run to replace")
    inputs.require_room("output", path)


def _is_run(path: Path) -> bool:
    from bladerub.io.hdf5 import read_attributes

    try:
        return path.is_file() and "run_key" in read_attributes(path)
    except OSError:
        return False


def _complete_coating(options: argparse.Namespace) -> None:
    """Fill in the default of what describes the coating; what does not belong to its kind is an error."""
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


def _in_words(figures: dict[str, Any]) -> str:
    order = figures["engine_order"]
    return "\n".join(
        [
            f"peak amplitude    {figures['peak_amplitude'] * 1e3:.4g} mm",
            f"engine order      {'none' if order is None else f'{order:.4g}'}",
            f"maximum wear      {figures['max_wear'] * 1e3:.4g} mm",
            f"lobes             {figures['lobes']}",
            f"growth            {_growth_in_words(figures)}",
            f"saturating        {'yes' if figures['saturating'] else 'no'}",
            f"divergent         {'yes' if figures['divergent'] else 'no'}",
            f"status            {figures['status']}",
            f"steps             {figures['n_steps']}",
            f"steps per second  {figures['steps_per_second']:.3g}",
        ]
    )


def _growth_in_words(figures: dict[str, Any]) -> str:
    growth, low, high = (figures[f"growth_{name}"] for name in ("per_revolution", "low", "high"))
    if growth is None:
        return "not measurable"
    interval = "" if low is None else f" (between {100 * low:.3g} and {100 * high:.3g} %)"
    return f"{100 * growth:.3g} % a revolution{interval}"
