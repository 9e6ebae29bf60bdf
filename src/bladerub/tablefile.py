"""Tables as plain CSV, each with a description beside it in the form of the W3C's "CSV on the Web".

``X.csv`` is for every program that reads CSV; ``X.csv-metadata.json`` says what its columns hold, in which
units, and where the table comes from.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.columns import COLUMNS


def write(
    path: str | Path, table: pd.DataFrame, origin: Mapping[str, str], float_format: str | None = None
) -> None:
    """Write `table` to `path`, without its index, and its description beside it.

    Parameters
    ----------
    path : path-like
        The CSV file; its folder is made if need be.
    table : DataFrame
        One observation a row; its columns are in `bladerub.columns.COLUMNS`.
    origin : mapping of str to str
        From `bladerub.provenance.provenance`.
    float_format : str, optional
        As of pandas.

    Raises
    ------
    ValueError
        If a column has no description, before anything is written.
    """
    path = Path(path)
    text = json.dumps(_description(path.name, table, origin), indent=2, ensure_ascii=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    table.to_csv(path, index=False, float_format=float_format)
    description_path(path).write_text(f"{text}\n", encoding="utf-8")


def description_path(path: str | Path) -> Path:
    """Return where the description of the table at `path` is: the place that the W3C names first."""
    path = Path(path)
    return path.with_name(f"{path.name}-metadata.json")


def _description(name: str, table: pd.DataFrame, origin: Mapping[str, str]) -> dict[str, Any]:
    unknown = [column for column in table.columns if column not in COLUMNS]
    if unknown:
        raise ValueError(f"{name}: columns without a description in bladerub.columns: {', '.join(unknown)}")
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
