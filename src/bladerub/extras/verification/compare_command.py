"""``bladerub compare``: numbers of another calculation or program beside reference numbers."""

import argparse
from pathlib import Path
from typing import Any

from bladerub.cli import inputs
from bladerub.cli.inputs import refused
from bladerub.io.errors import BadInput
from bladerub.io.folders import BENCHMARKS

DIFFERENT = 1
"""Exit code where a number is outside of its uncertainty."""


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "compare",
        help="compare numbers with reference numbers",
        description="Compare the tables of a folder with the reference tables of the same names, by the "
        "column `number`. Numbers agree where they differ by no more than twice their joint uncertainty. "
        "Those that do not are listed, and the exit code is 1.",
        epilog="A table needs the columns number and value. It may have unit, which must then be that of the "
        "reference, and uncertainty, without which its numbers count as exact.",
    )
    parser.set_defaults(command=compare)
    parser.add_argument("folder", type=Path, help="tables to compare", metavar="FOLDER")
    text = "tables with the columns number, value, unit and uncertainty; rotor37: those of the package"
    parser.add_argument("reference", type=Path, help=text, metavar="REFERENCE")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def compare(options: argparse.Namespace) -> int:
    """Compare the tables that the command line names, and print what differs."""
    from bladerub.extras.verification.compare import compare as compare_tables

    package_folder = BENCHMARKS / options.reference
    reference = (
        package_folder if package_folder.is_dir() and not options.reference.is_dir() else options.reference
    )
    for folder in (options.folder, reference):
        if not folder.is_dir():
            raise BadInput(f"{folder}: there is no such folder")
    with refused(ValueError, OSError):
        table = compare_tables(options.folder, reference)
    different = table[~table.agrees]
    figures = {
        "compared": len(table),
        "different": different.drop(columns="agrees").to_dict(orient="records"),
    }
    inputs.show(options, figures, _in_words)
    return DIFFERENT if len(different) else 0


def _in_words(figures: dict[str, Any]) -> str:
    rows, n = figures["different"], figures["compared"]
    lines = [f"{n - len(rows)} of {n} numbers agree with the reference within the uncertainties"]
    if rows:
        width = 2 + max(len(f"{row['table']}/{row['number']}") for row in rows)
        lines += ["", inputs.row(width, "outside", "value", "reference", "within", "unit")]
        lines += [
            inputs.row(
                width,
                f"{row['table']}/{row['number']}",
                *(f"{row[key]:.5g}" for key in ("value", "reference", "allowed")),
                row["unit"],
            )
            for row in rows
        ]
    return "\n".join(lines)
