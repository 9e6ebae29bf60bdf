"""``bladerub compare``: numbers of another calculation or program beside reference numbers."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bladerub.cli import inputs
from bladerub.cli.inputs import refused
from bladerub.io.errors import BadInput
from bladerub.io.folders import BENCHMARKS

if TYPE_CHECKING:
    import pandas as pd

READ = ["number", "value"]  # that a compared table must have; it may have ``unit`` and ``uncertainty``
COLUMNS = ["table", "number", "reference", "value", "allowed", "unit", "agrees"]
COVERAGE = 2.0  # times the joint uncertainty that two numbers may differ: 95 % of them, if errors are normal
_DIGITS = 1e-6  # relative; tables have seven digits


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
    parser.set_defaults(command=_command)
    parser.add_argument("folder", type=Path, help="tables to compare", metavar="FOLDER")
    text = "tables with the columns number, value, unit and uncertainty; rotor37: those of the package"
    parser.add_argument("reference", type=Path, help=text, metavar="REFERENCE")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def _command(options: argparse.Namespace) -> int:
    """Compare the tables that the command line names, and print what differs."""
    reference = options.reference
    if not reference.is_dir() and (BENCHMARKS / reference).is_dir():
        reference = BENCHMARKS / reference
    for folder in (options.folder, reference):
        if not folder.is_dir():
            raise BadInput(f"{folder}: there is no such folder")
    with refused(ValueError, OSError):
        table = compare(options.folder, reference)
    compared = table.dropna(subset="value")
    different = compared[~compared.agrees].drop(columns="agrees").to_dict(orient="records")
    figures = {"compared": len(compared), "missing": len(table) - len(compared), "different": different}
    inputs.show(options, figures, _in_words)
    return 1 if different else 0


def _in_words(figures: dict[str, Any]) -> str:
    rows, n = figures["different"], figures["compared"]
    missing = f"; {figures['missing']} more of these tables are missing" if figures["missing"] else ""
    lines = [f"{n - len(rows)} of {n} numbers agree with the reference within the uncertainties{missing}"]
    if rows:
        width = 2 + max(len(f"{row['table']}/{row['number']}") for row in rows)
        lines += ["", inputs.row(width, "outside", "value", "reference", "within", "unit")]
    for row in rows:
        cells = (f"{row[key]:.5g}" for key in ("value", "reference", "allowed"))
        lines.append(inputs.row(width, f"{row['table']}/{row['number']}", *cells, row["unit"]))
    return "\n".join(lines)


def compare(folder: str | Path, reference: str | Path) -> "pd.DataFrame":
    """Compare the tables of `folder` with those of `reference` that have the same names.

    Two numbers agree where they differ by no more than `COVERAGE` times the root of the sum of squares of
    their uncertainties, 0 where there is none; ``value`` is NaN of one that a table lacks. Raises ValueError
    if the folders have no number in common, or one is none, is there twice or has another unit; OSError if a
    table cannot be read or lacks a column.
    """
    import pandas as pd  # which commands that read no table do without

    from bladerub.io import tables

    folder, parts = Path(folder), []
    for path in sorted(Path(reference).glob("*.csv")):
        reference_table = tables.read(path)
        if not {*READ, "uncertainty", "unit"} <= set(reference_table) or not (folder / path.name).is_file():
            continue
        table = tables.read(folder / path.name, READ)
        for name, content in ((path, reference_table), (folder / path.name, table)):
            _check_numbers(name, content)
            if "unit" in content:  # "1" is read as a number
                content["unit"] = content["unit"].astype(str)
        compared = table.reindex(columns=[*READ, "unit", "uncertainty"])
        both = reference_table.merge(compared, how="left", on="number", suffixes=("_reference", ""))
        other = both[both.value.notna() & (both.unit != both.unit_reference)]
        for row in other.itertuples() if "unit" in table else ():
            wrong = f"{row.number} is in {row.unit}; must be in {row.unit_reference}"
            raise ValueError(f"{folder / path.name}: {wrong}")
        joint = np.hypot(both.uncertainty_reference, both.uncertainty.astype(float).fillna(0.0))
        both["allowed"] = COVERAGE * joint + _DIGITS * both.value_reference.abs()
        both["agrees"] = (both.value - both.value_reference).abs() <= both.allowed
        both = both.assign(table=path.stem, unit=both.unit_reference, reference=both.value_reference)
        parts.append(both[COLUMNS])
    if not any(part.value.notna().any() for part in parts):
        raise ValueError(f"{folder}: has no number in common with {reference}")
    return pd.concat(parts, ignore_index=True)


def _check_numbers(path: Path, table: "pd.DataFrame") -> None:
    import pandas as pd

    for column in table.columns.intersection(["value", "uncertainty"]):
        cells = table[column].dropna()
        for cell in cells[pd.to_numeric(cells, errors="coerce").isna()]:
            raise ValueError(f"{path}: {column} = {cell}: must be a number")
    for number in table.number[table.number.duplicated()]:
        raise ValueError(f"{path}: number = {number}: is there twice")
