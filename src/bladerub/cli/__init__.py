"""The command ``bladerub``: each of its commands is a module with `add_to`, which names its options.

All but ``run`` are of `bladerub.extras` (`bladerub.plugins`).
"""

import argparse
import os
import sys
from io import TextIOWrapper
from typing import Any

from bladerub import __version__, plugins
from bladerub.cli import run
from bladerub.cli.inputs import Parser
from bladerub.config.errors import ConfigError
from bladerub.io.errors import BadInput, exit_on_error, message_for
from bladerub.io.folders import provide_for_unknown_user
from bladerub.workflow.job import collect_seldom


def parser() -> argparse.ArgumentParser:
    """Make the parser of all commands, from which the site's reference is made as well."""
    root = Parser("bladerub", description="Contact of a compressor blade with its abradable coating.")
    root.add_argument("--version", action="version", version=f"bladerub {__version__}")
    commands = root.add_subparsers(title="commands", dest="name", required=True, metavar="COMMAND")
    run.add_to(commands)
    for name, place in plugins.offered("COMMANDS").items():
        if name in commands.choices:
            raise plugins.MissingPart(f"{place}: {name}: is a command of bladerub, must have another name")
        plugins.load(f"{place}:add_to")(commands)
        if name not in commands.choices:
            raise plugins.MissingPart(f"{place}: add_to: adds no command {name}, as its plugin.py says")
    return root


def _write_any_text(stream: Any) -> None:
    """Let a stream take any text: a terminal shows ``?`` for what it lacks, a file is UTF-8 in any locale."""
    if isinstance(stream, TextIOWrapper):
        if stream.isatty():
            stream.reconfigure(errors="replace")
        else:
            stream.reconfigure(encoding="utf-8", errors="surrogateescape")


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; return 0, 1 where numbers differ, 2 on bad input, 130 when interrupted."""
    collect_seldom()
    for stream in (sys.stdout, sys.stderr):
        _write_any_text(stream)
    with exit_on_error():  # what a plugin names and is not there
        options = parser().parse_args(arguments)
    code, message = 2, None
    try:
        provide_for_unknown_user()
        exit_code = options.command(options)
        print(end="", flush=True)  # standard output may be closed
        return exit_code or 0
    except ConfigError as error:
        print(error, file=sys.stderr)
        return 2
    except (BadInput, plugins.MissingPart) as error:
        message = " ".join(str(error).split())
    except BrokenPipeError:  # the reader, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        message = message_for(error)
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith("bladerub.extras."):
            raise
        message = f"needs {error.name}, which this package is without"
    except KeyboardInterrupt:
        code, message = 130, "interrupted"
    print(f"bladerub {options.name}: {message}", file=sys.stderr)
    return code
