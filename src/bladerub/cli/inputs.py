"""The study and the blade that a command works on: its options for them, and their reading."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub.cli.errors import InputError
from bladerub.config import read as configuration
from bladerub.config.errors import format_value
from bladerub.io.errors import BadInput
from bladerub.io.sources import ROOT

if TYPE_CHECKING:  # the rest of the package is imported when it is sure to be needed: numba takes its time
    from bladerub.blade.model import ReducedBlade

BASE_CONFIG = ROOT / "config" / "config.yaml"


def add_to(parser: argparse.ArgumentParser) -> None:
    """Add ``--config`` and ``--blade`` to the options of a command."""
    add_config_to(parser)
    parser.add_argument(
        "--blade", type=Path, metavar="FILE", help="reduced blade (default: the one in the results folder)"
    )


def add_config_to(parser: argparse.ArgumentParser) -> None:
    """Add ``--config`` to the options of a command."""
    parser.add_argument(
        "--config",
        nargs="+",
        default=[],
        action="extend",
        metavar="FILE",
        help="YAML files laid over config/config.yaml, in order",
    )


def require(options: argparse.Namespace, **bounds: tuple[int, int]) -> None:
    """Check options by name against the smallest and largest value of each; one that was not given passes.

    Raises
    ------
    InputError
        If one is beyond them.
    """
    for option, (smallest, largest) in bounds.items():
        value = getattr(options, option)
        if value is not None and not smallest <= value <= largest:
            raise InputError(f"--{option} = {format_value(value)}: must be from {smallest} to {largest}")


def require_room(option: str, path: Path) -> None:
    """Check that `path`, which need not be there, lies in a folder that can be written to or made.

    Raises
    ------
    InputError
        If not; it names `option`.
    """
    folder = next(parent for parent in path.absolute().parents if os.path.lexists(parent))
    if not folder.is_dir():
        raise InputError(f"--{option} {path}: cannot be written, {folder} is no folder")
    if not os.access(folder, os.W_OK):
        raise InputError(f"--{option} {path}: cannot be written, {folder} is write-protected")


def read_config(options: argparse.Namespace) -> dict[str, Any]:
    """Read and check the config of the repository with the files of ``--config`` laid over it.

    Raises
    ------
    ConfigError
        If it is at problem.
    """
    return configuration.read(BASE_CONFIG, *options.config)


def blade_path(options: argparse.Namespace, config: dict[str, Any]) -> Path:
    """Return the file of ``--blade``, or where the blade of the results folder is or will be."""
    return options.blade or ROOT / config["results"] / "blade" / "reduced_model.h5"


def read_blade(options: argparse.Namespace, config: dict[str, Any]) -> tuple[Path, ReducedBlade]:
    """Read the reduced blade, build it if there is none; clearances are in lengths of that blade.

    Parameters
    ----------
    options
        The command's, with ``blade`` and its ``name``.
    config : dict
        The study; its ``blade.length`` becomes that of a blade named by ``--blade``.

    Raises
    ------
    InputError
        If the file is no valid reduced blade, or was built from another config, or the blade cannot be built.
    OSError
        If the files of the default blade are damaged or cannot be written.
    """
    from bladerub.blade.validation import read_valid_blade
    from bladerub.workflow import invocation

    path = blade_path(options, config)
    if not options.blade and not (path.exists() and _mesh_of(path).exists()):
        invocation.prepare(path.parents[1])
        print(f"bladerub {options.name}: building the blade first, into {path.parent}", file=sys.stderr)
        _build_blade(config, path)
    elif not options.blade and not is_of(config, path):
        raise InputError(
            f"{path}: was built from another config; build it again with snakemake, delete it, or name it "
            "with --blade"
        )
    try:
        blade = read_valid_blade(path)
    except OSError as error:
        if options.blade and error.errno is None:  # damaged, and it cannot be made anew
            raise InputError(str(error)) from error
        raise
    except ValueError as error:
        raise InputError(str(error)) from error
    if options.blade:
        config["blade"]["length"] = blade.length
    return path, blade


def is_of(config: dict[str, Any], path: Path) -> bool:
    """Tell whether the reduced blade at `path` was built from `config`.

    Raises
    ------
    OSError
        If its mesh, which tells, is missing or damaged.
    """
    from bladerub.blade.build import made_from
    from bladerub.io import hdf5

    return hdf5.read_attributes(_mesh_of(path)).get("made_from") == made_from(config)


def _mesh_of(path: Path) -> Path:
    return path.with_name("mesh.h5")


def _build_blade(config: dict[str, Any], path: Path) -> None:
    from bladerub.blade.build import build
    from bladerub.blade.built import write
    from bladerub.blade.rotation import EquilibriumError
    from bladerub.io.provenance import provenance

    try:
        built = build(config)
    except (BadInput, EquilibriumError) as error:
        raise InputError(str(error)) from error
    tables = path.parents[1] / "tables"
    campbell, accuracy = tables / "campbell.csv", tables / "rom_accuracy.csv"
    write(built, provenance(config), path, _mesh_of(path), campbell, accuracy)
