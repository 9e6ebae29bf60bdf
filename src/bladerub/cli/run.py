"""``bladerub run``: one simulation, summed up."""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from shutil import get_terminal_size
from typing import TYPE_CHECKING, Any

from tqdm import tqdm

from bladerub.cli.errors import InputError
from bladerub.config import ROOT, check_quantity, load, validate

if TYPE_CHECKING:  # the rest of the package is imported when a run is sure to be made: numba takes its time
    from bladerub.blade.model import ReducedBlade

BASE_CONFIG = ROOT / "config" / "config.yaml"


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "run",
        help="run one simulation",
        description="Let the blade rub at one speed on one coating, which need not be in the config. "
        "The blade is built first if the results folder has none yet.",
    )
    parser.set_defaults(command=run)
    parser.add_argument("--casing", required=True, help="name of a casing of the config, such as 2nd")
    parser.add_argument("--E", required=True, type=float, help="Young modulus of the coating (normalised)")
    parser.add_argument("--K", required=True, type=float, help="plastic modulus of the coating (normalised)")
    parser.add_argument("--theta", default=0.0, type=float, help="angle of its elements, rad (default 0)")
    parser.add_argument("--f", required=True, type=float, metavar="F_OMEGA", help="speed (normalised)")
    parser.add_argument(
        "--config",
        nargs="+",
        default=[],
        action="extend",
        metavar="FILE",
        help="YAML files laid over config/config.yaml, in order",
    )
    parser.add_argument(
        "--revolutions", type=int, metavar="N", help="instead of solver.revolutions, at least 2"
    )
    parser.add_argument(
        "--blade", type=Path, metavar="FILE", help="reduced blade (default: the one in the results folder)"
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
        If the config is at fault.
    InputError
        If an option is.
    """
    config = _config(options)
    _check_options(options, config)
    blade_path, blade = _blade(options, config)

    from bladerub.contact.run import kernel_warm_up, simulate
    from bladerub.study.grid import CoatingCase, run_spec
    from bladerub.study.key import blade_digest, run_key
    from bladerub.study.store import write_run
    from bladerub.study.summary import summarise

    if options.f > blade.f_omega_max:
        raise InputError(
            f"--f = {options.f:g}: must be at most {blade.f_omega_max:g} (normalised), the highest speed of "
            f"{blade_path}"
        )
    case = CoatingCase(options.casing, options.E, options.K, options.theta)
    spec = run_spec(config, case, options.f)
    kernel_warm_up()
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
        key = run_key(spec, blade_digest(blade_path), True, config["analysis"])
        try:
            write_run(options.output, spec, result, case, key, config["analysis"], keep_history=True)
        except OSError as error:
            raise InputError(f"--output {options.output}: cannot be written ({error})") from error
    print(json.dumps(figures, indent=2) if options.json else _in_words(figures))


def _config(options: argparse.Namespace) -> dict[str, Any]:
    config = validate(load(BASE_CONFIG, *options.config))
    if options.revolutions is not None:
        if not 2 <= options.revolutions <= 10_000:
            raise InputError(f"--revolutions = {options.revolutions}: must be from 2 to 10000")
        config["solver"]["revolutions"] = options.revolutions
        analysis, divergence = config["analysis"], config["analysis"]["divergence"]
        analysis["spectrum_revolutions"] = min(analysis["spectrum_revolutions"], options.revolutions)
        divergence["revolutions"] = min(divergence["revolutions"], options.revolutions)
    return config


def _check_options(options: argparse.Namespace, config: dict[str, Any]) -> None:
    if options.casing not in config["casings"]:
        raise InputError(f'--casing = "{options.casing}": must be one of {", ".join(config["casings"])}')
    for option, name in (("E", "E"), ("K", "K"), ("theta", "theta"), ("f", "f_omega")):
        value = getattr(options, option)
        try:
            check_quantity(name, value)
        except ValueError as error:
            raise InputError(f"--{option} = {value:g}: {error}") from error
    if options.output and options.output.is_dir():
        raise InputError(f"--output {options.output}: is a folder, must be a file")


def _blade(options: argparse.Namespace, config: dict[str, Any]) -> tuple[Path, ReducedBlade]:
    """Read the reduced blade, build it if there is none; clearances are in lengths of that blade."""
    from bladerub.blade.model import read_reduced_blade

    path = options.blade or ROOT / config["results"] / "blade" / "reduced_model.h5"
    if not options.blade and not path.exists():
        _build_blade(config, path)
    elif not options.blade and not _is_of(config, path):
        raise InputError(
            f"{path}: was built from another config; build it again with snakemake, delete it, or name it "
            "with --blade"
        )
    try:
        blade = read_reduced_blade(path)
    except OSError as error:
        raise InputError(str(error)) from error
    if options.blade:
        config["blade"]["length"] = blade.length
    return path, blade


def _is_of(config: dict[str, Any], path: Path) -> bool:
    from bladerub import datafile
    from bladerub.blade.build import made_from

    try:
        return datafile.read_attributes(path.with_name("mesh.h5")).get("made_from") == made_from(config)
    except OSError:
        return False


def _build_blade(config: dict[str, Any], path: Path) -> None:
    from bladerub.blade import build
    from bladerub.blade.rotation import EquilibriumError

    print(f"bladerub run: building the blade first, into {path.parent}", file=sys.stderr)
    try:
        built = build.build(config)
    except EquilibriumError as error:
        raise InputError(str(error)) from error
    tables = path.parents[1] / "tables"
    build.write(built, path, path.with_name("mesh.h5"), tables / "campbell.csv", tables / "rom_accuracy.csv")


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
