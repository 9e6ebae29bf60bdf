"""The command ``bladerub``; each of its commands is a module that says what it does in `add_to`."""

from __future__ import annotations

import argparse
import sys
from typing import NoReturn

from bladerub import __version__
from bladerub.cli import benchmark, export, import_blade, run, status, verify
from bladerub.cli.errors import InputError
from bladerub.config.errors import ConfigError
from bladerub.io import errors


class _Parser(argparse.ArgumentParser):
    """Answers a bad command line with one line, not with the whole usage."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; return 0 on success, 2 on bad input, 130 when interrupted."""
    parser = _Parser(prog="bladerub", description="Rub of a compressor blade on its abradable coating.")
    parser.add_argument("--version", action="version", version=f"bladerub {__version__}")
    commands = parser.add_subparsers(title="commands", dest="name", required=True, metavar="COMMAND")
    run.add_to(commands)
    status.add_to(commands)
    verify.add_to(commands)
    benchmark.add_to(commands)
    export.add_to(commands)
    import_blade.add_to(commands)
    options = parser.parse_args(import_blade.joined(sys.argv[1:] if arguments is None else arguments))
    try:
        options.command(options)
    except ConfigError as error:
        print(error, file=sys.stderr)
        return 2
    except InputError as error:
        print(f"bladerub {options.name}: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"bladerub {options.name}: {errors.message_for(error)}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"bladerub {options.name}: interrupted", file=sys.stderr)
        return 130
    return 0
