"""``bladerub config``: whether a config is valid, without running anything that it names."""

import argparse
import sys
from typing import Any

from bladerub.config.read import read_with_notes
from bladerub.io.folders import base_config
from bladerub.settings.units import moduli_in_words, pressure_in_words, speeds_in_words


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "config",
        help="check a config file and run nothing of it",
        description="Read YAML files, check them as snakemake does, and say what they plan and what it would "
        "execute. Nothing of them is run: neither templates, which Snakemake runs in a file of --configfile, "
        "nor the law of a coating.",
    )
    text = "YAML files laid over config/config.yaml, in order"
    parser.add_argument("files", nargs="*", metavar="FILE", help=text)
    text = "print the JSON schema of such a file, for editors"
    parser.add_argument("--schema", action="store_true", help=text)
    parser.set_defaults(command=check)


def check(options: argparse.Namespace) -> None:
    """Check the config that the command line names; raises `ConfigError`."""
    if options.schema:
        from bladerub.extras.config import json_schema

        print(json_schema.text(), end="")
        return
    config, notes = read_with_notes(base_config(), *options.files)

    from bladerub.blade.cache import kept_frequency
    from bladerub.study.grid import coating_cases, modulus_unit, speeds, young_moduli

    for note in notes:
        print(f"bladerub config: {note}", file=sys.stderr)
    n_coatings, n_speeds = len(coating_cases(config)), len(speeds(config))
    runs = f"{n_coatings * n_speeds:,} runs, in {config.results}"
    print(f"valid: {n_coatings} coatings at {n_speeds} speeds are {runs}")
    print(f"speeds: {speeds_in_words(speeds(config), kept_frequency(config))}")
    moduli = moduli_in_words(young_moduli(config))
    print(f"E = 1 and K = 1: {pressure_in_words(modulus_unit(config))}{moduli}")
    law = config.contact.plugged("law")
    file = law and law.file
    print(f"executes {file}, the law of the coatings: read it as any program" if file else "executes no file")
