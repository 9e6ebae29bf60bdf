"""What the commands share: options, the study and the blade that they name, errors, progress and output."""

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from bladerub import plugins
from bladerub.config import read as configuration
from bladerub.io.errors import BadInput, DamagedFile, message_for
from bladerub.io.folders import base_config, study_folder
from bladerub.io.values import plain
from bladerub.settings import units

if TYPE_CHECKING:  # imports that load numba are made where they are needed, so that --help answers at once
    from bladerub.api.blade import Blade
    from bladerub.settings.study import Config


class Parser(argparse.ArgumentParser):
    """Reports a bad command line in one line, without the usage."""

    def __init__(self, *args: Any, **keywords: Any):
        super().__init__(*args, **keywords)
        self._choices: dict[str, Iterable[str]] = {}  # by option

    def error(self, message: str) -> NoReturn:
        """Exit with code 2."""
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")

    def option(
        self, name: str, text: str, kind: Callable | None = None, group: Any = None, **keywords: Any
    ) -> None:
        """Add an option of this kind (default text) with its help text, perhaps to one of its groups."""
        action = (group or self).add_argument(name, type=kind, help=text, **keywords)
        self._choices[name] = action.choices or ()

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse all arguments; for one that is not known the help of the command is named."""
        options, unknown = self.parse_known_args(args, namespace)
        if unknown:
            self.prog += f" {options.name}"
            hint = "; a config: --config FILE" if "config" in options and unknown[0].endswith(".yaml") else ""
            self.error(f"unrecognized arguments: {' '.join(unknown)}{hint}")
        return options

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse, with ``--downstream -z`` as ``--downstream=-z`` if that is a choice, or a quantity."""
        words: list[str] = []
        for word in sys.argv[1:] if args is None else args:
            choices = self._choices.get(words[-1]) if words and word.startswith("-") else None
            if choices is not None and (word in choices or units.read(word)):
                words[-1] += f"={word}"
            else:
                words.append(word)
        return super().parse_known_args(words, namespace)


@contextmanager
def as_options(**names: str) -> Iterator[None]:
    """Turn the error of an argument of the Python interface into that of the option of this or its name."""
    from bladerub.api.arguments import InputError

    try:
        yield
    except InputError as error:
        option = names.get(error.name, error.name).replace("_", "-")
        hint = " (for a casing of another config: --config FILE)" if option == "casing" else ""
        raise BadInput(f"--{option} = {error.value}: {error.right}{hint}") from None


@contextmanager
def refused(*kinds: type[Exception], because: str = "") -> Iterator[None]:
    """Turn errors of these kinds into `BadInput`, with the words `because` before their message.

    A damaged file after them is one that the user names, which nothing makes again.
    """
    try:
        yield
    except kinds as error:
        is_own = isinstance(error, OSError) and not (because and isinstance(error, DamagedFile))
        text = message_for(error) if is_own else str(error)
        raise BadInput(because + text) from error


def add_command(commands: Any, name: str, command: Callable, blade: bool = True, **texts: str) -> Parser:
    """Add a command with ``--config``, ``--json`` and perhaps ``--blade`` to the subparsers `commands`."""
    parser = commands.add_parser(name, **texts)
    parser.set_defaults(command=command)
    text = "YAML files laid over config/config.yaml, in order"
    parser.option("--config", text, nargs="+", default=[], action="extend", metavar="FILE")
    if blade:
        text = "reduced blade (default: the one in the results folder)"
        parser.option("--blade", text, Path, metavar="FILE")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")
    return parser


def require_writable(option: str, path: Path) -> None:
    """Check that `path`, which need not exist, is in a folder that can be written to or made."""
    folder = next(parent for parent in path.absolute().parents if os.path.lexists(parent))
    if not folder.is_dir():
        raise BadInput(f"{option} {path}: cannot be written, {folder} is no folder")
    if not os.access(folder, os.W_OK):
        raise BadInput(f"{option} {path}: cannot be written, {folder} is write-protected")


def show(options: argparse.Namespace, figures: dict[str, Any], in_words: Callable[[dict], str]) -> None:
    """Print the figures, as JSON if that is asked for; what is not finite is null there."""
    print(json.dumps(plain(figures), indent=2, allow_nan=False) if options.json else in_words(figures))


def row(width: int, name: str, *cells: str) -> str:
    """Write a row of a table: its name in this width, then its cells."""
    return f"{name:<{width}}" + "".join(f"{cell:>12}" for cell in cells)


def large_in_words(over_length: float) -> str:
    """Say so where a displacement over the length of the blade is large; else nothing."""
    from bladerub.study.summary import LARGE_DISPLACEMENT

    if over_length < LARGE_DISPLACEMENT:
        return ""
    return f", {100 * over_length:.2g} % of the length: beyond the small displacements of the model"


def warn_of_residual(options: argparse.Namespace, residual: float | None) -> None:
    """Say on standard error where the energy ledger of a run misses too much."""
    from bladerub.contact.result import UNBALANCED

    if residual is not None and not residual <= UNBALANCED:
        print(
            f"bladerub {options.name}: the energy ledger misses {residual:.2g} of the work exchanged in the "
            f"contact, more than {UNBALANCED:g}: do not trust the run; lower solver.tolerance",
            file=sys.stderr,
        )


def aligned(rows: Iterable[tuple[str, str]]) -> list[str]:
    """Write pairs of name and value as lines, the values in one column."""
    rows = list(rows)
    width = max(len(name) for name, _ in rows) + 2
    return [f"{name:<{width}}{value}" for name, value in rows]


def read_config(options: argparse.Namespace) -> "Config":
    """Read the study's config as `read_config_with_notes`."""
    return read_config_with_notes(options)[0]


def read_config_with_notes(options: argparse.Namespace) -> "tuple[Config, list[str]]":
    """Read and check the study's config with the files of ``--config`` laid over it.

    Without ``--config``, what plugs in (``RECORDS``) lays over it what made the results. Returns notes, too.
    """
    base = base_config()
    records = [] if options.config else [*plugins.loaded("RECORDS").values()]
    if records:
        return records[0].read_config(options, base, study_folder())
    return configuration.read_with_notes(base, *options.config)


def add_trust_to(parser: Parser) -> None:
    """Add ``--trust`` to the options of a command that simulates."""
    text = "execute the law that the record of the results folder names, which may be from somebody else"
    parser.add_argument("--trust", action="store_true", help=text)


def quantity(text: str) -> float | str:
    """Read an option that is a number, or one with a unit, which stays text until the study is known."""
    with suppress(ValueError):
        return float(text)
    if units.read(text) is None:
        right = f"must be a number, or one with a unit: {text!r}{units.comma(text)}"
        raise argparse.ArgumentTypeError(right)
    return text


def number(text: str) -> float:
    """Read an option that is a number without a unit."""
    try:
        return float(text)
    except ValueError:
        unit = f", without the unit {read.unit}" if (read := units.read(text)) else ""
        raise argparse.ArgumentTypeError(f"must be a number{unit}: {text!r}") from None


def blade_path(options: argparse.Namespace, config: "Config") -> Path:
    """Return the file of ``--blade``, or where the blade of the results folder is or will be."""
    return options.blade or study_folder() / config.results / "blade" / "reduced_model.h5"


def read_blade(options: argparse.Namespace, config: "Config") -> "tuple[Blade, Config]":
    """Read the reduced blade, and build it first if the results folder has none.

    The config returned with it has the length of a blade given with ``--blade``: clearances are in this unit.
    A damaged file is an `OSError` if the command can make it again, a `BadInput` if not.
    """
    from bladerub.api import blade as blades
    from bladerub.blade.files import is_built, missing_file
    from bladerub.workflow import invocation

    path = blade_path(options, config)
    if not options.blade and missing_file(path):
        invocation.prepare(path.parents[1])
        print(f"bladerub {options.name}: building the blade first, into {path.parent}", file=sys.stderr)
        with refused(ValueError):
            blades.write_blade(config, path)
    elif not options.blade and not is_built(config, path):
        raise BadInput(
            f"{path}: was built from another config; name that with --config, build it again with "
            "snakemake, delete it, or name another blade with --blade"
        )
    try:
        with refused(ValueError):
            blade = blades.read_blade(path)
    except OSError as error:
        if options.blade and error.errno is None:  # damaged, and it cannot be made again
            raise BadInput(str(error)) from error
        raise
    if options.blade:
        config = config.replaced("blade.length", blade.length)
    with suppress(OSError):  # a blade from elsewhere may be without its table
        for doubt in blade.doubts(config.figures.nominal_speed):
            print(f"bladerub {options.name}: {path}: {doubt}", file=sys.stderr)
    return blade, config
