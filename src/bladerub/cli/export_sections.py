"""The sections of the parametric blade as a table, a part of ``bladerub export``."""

from __future__ import annotations

import argparse
from typing import Any

from bladerub.blade.sources.origin import TABLE_SUFFIXES
from bladerub.cli.errors import InputError
from bladerub.io import errors

COORDINATES = ("cartesian", "cylindrical")


def write(options: argparse.Namespace, config: dict[str, Any]) -> dict[str, Any]:
    """Write the table that the command line asks for; return how large it is.

    Raises
    ------
    InputError
        If an option is at fault, or the blade of the config has no sections of its own.
    """
    path = options.sections
    if path.suffix.lower() not in TABLE_SUFFIXES:
        raise InputError(f"--sections {path}: must end in {', '.join(TABLE_SUFFIXES)}")
    if "source" in config["blade"]:
        raise InputError(
            f"--sections {path}: the blade of the config comes from {config['blade']['source']['file']}; "
            "only a parametric one has sections"
        )

    from bladerub.blade.geometry import BladeShape
    from bladerub.export.sections import write_sections

    coordinates = options.coordinates or COORDINATES[0]
    try:
        n_sections, n_stations = write_sections(path, BladeShape.from_config(config["blade"]), coordinates)
    except ValueError as error:
        raise InputError(f"--coordinates {coordinates}: {error}") from error
    except OSError as error:
        raise InputError(errors.message_for(error)) from error
    return {"files": [str(path)], "coordinates": coordinates, "sections": n_sections, "stations": n_stations}


def in_words(figures: dict[str, Any]) -> str:
    """Say what was written."""
    (file,) = figures["files"]
    size = f"{figures['sections']} sections, {figures['stations']} stations in all"
    return f"{size}, in m and rad, {figures['coordinates']} coordinates\nwrote {file}"
