"""Tables as plain CSV, each with a description beside it in the form of the W3C's "CSV on the Web".

``X.csv`` is for every program that reads CSV; ``X.csv-metadata.json`` says what its columns hold, in which
units, and where the table comes from.
"""

from __future__ import annotations

import io
import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.io import atomic
from bladerub.io.columns import COLUMNS
from bladerub.io.errors import DamagedFile


def write(
    path: str | Path, table: pd.DataFrame, origin: Mapping[str, str], float_format: str | None = None
) -> None:
    """Write `table` to `path`, without its index, and its description beside it.

    Parameters
    ----------
    path : path-like
        The CSV file; its folder is made if need be.
    table : DataFrame
        One observation a row; its columns are in `bladerub.io.columns.COLUMNS`.
    origin : mapping of str to str
        From `bladerub.io.provenance.provenance`.
    float_format : str, optional
        As of pandas.

    Raises
    ------
    ValueError
        If a column has no description, before anything is written.
    """
    path = Path(path)
    text = json.dumps(_description(path.name, table, origin), indent=2, ensure_ascii=False)
    with atomic.writing(path) as stream:
        table.to_csv(stream, index=False, float_format=float_format)
    with atomic.writing(description_path(path)) as stream:
        stream.write(f"{text}\n")


def read(path: str | Path, columns: Collection[str] = (), separator: str = ",") -> pd.DataFrame:
    """Read a table of which every row must be whole.

    Parameters
    ----------
    path : path-like
        The file.
    columns : collection of str, optional
        Columns that it must have.
    separator : str, optional
        Between the cells.

    Raises
    ------
    OSError
        If the file is missing, breaks off, is not a table or lacks one of `columns`; the message names it.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
        if not text.endswith("\n"):
            raise DamagedFile(f"{path}: not a whole table, it breaks off in its last line")
        table = pd.read_csv(io.StringIO(text), sep=separator)
    except (UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise DamagedFile(f"{path}: not a table ({str(error).strip()})") from error
    missing = [column for column in columns if column not in table.columns]
    if missing:
        raise DamagedFile(f"{path}: not the right table, {', '.join(missing)} missing")
    return table


def description_path(path: str | Path) -> Path:
    """Return where the description of the table at `path` is: the place that the W3C names first."""
    path = Path(path)
    return path.with_name(f"{path.name}-metadata.json")


def _description(name: str, table: pd.DataFrame, origin: Mapping[str, str]) -> dict[str, Any]:
    unknown = [column for column in table.columns if column not in COLUMNS]
    if unknown:
        raise ValueError(f"{name}: columns not described in bladerub.io.columns: {', '.join(unknown)}")
    return {
        "@context": ["http://www.w3.org/ns/csvw", {"@language": "en"}],
        "url": name,
        "dc:provenance": [{"schema:name": key, "schema:value": value} for key, value in origin.items()],
        "tableSchema": {"columns": [_column(column) for column in table.columns]},
    }


def _column(name: str) -> dict[str, Any]:
    datatype, unit, description = COLUMNS[name]
    about = {"name": name, "titles": name, "datatype": datatype, "dc:description": description}
    return about if unit is None else about | {"schema:unitText": unit}
